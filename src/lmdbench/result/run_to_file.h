// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/run/run.h>

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// Runs an experiment and leaves a result file, which gets its name only when complete: until then
/// an earlier file stays whole. A file that cannot be written shows before the run. During the run
/// `<file>.part` holds every measured frame (RunKeeper), whatever ends the run, and
/// `Leftover::RESUME` continues from there.
/// @throws Interrupted when `progress` returned false
/// @throws EnvironmentError when the part holds frames of an interrupted run that is not resumed
RunResult run_experiment_to_file(const Experiment& experiment, const std::filesystem::path& file,
                                 const std::vector<std::string>& argv, const RunProgress& progress = {},
                                 Leftover leftover = Leftover::REFUSE);

}  // namespace lmdbench
