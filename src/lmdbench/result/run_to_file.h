// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/run/run.h>

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// Runs an experiment and leaves a result file, which takes its name only when it is complete: an earlier file of that
/// name stays whole until then. A file that cannot be written is noticed before the run, not after it. While it
/// runs, `<file>.part` holds every frame that was measured (RunKeeper): whatever ends the run, they stay there,
/// and `Leftover::RESUME` goes on with them.
/// @throws Interrupted when `progress` returned false
/// @throws EnvironmentError when the part holds what an interrupted run measured and shall not be resumed
RunResult run_experiment_to_file(const Experiment& experiment, const std::filesystem::path& file,
                                 const std::vector<std::string>& argv, const RunProgress& progress = {},
                                 Leftover leftover = Leftover::REFUSE);

}  // namespace lmdbench
