// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/run.h>
#include <lmdbench/sweep/journal.h>
#include <lmdbench/sweep/point_result.h>
#include <lmdbench/sweep/sweep.h>

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// What a sweep leaves, point by point.
struct SweepResult {
  std::vector<PointResult> points;  ///< In the order of the sweep's.
  std::int64_t resumed_runs = 0;    ///< Of points and repetitions, those that the journal knew.
  double clock_overhead_s = 0.0;    ///< Part of every time.
  std::vector<InputFile> inputs;    ///< With the hashes of the bytes that were used.
};

/// Runs the points that the journal does not know. Points of one scene, path and force take turns: each repetition
/// goes through them in a new random order, so that neither a drift of the machine's speed nor what another point
/// leaves in the caches favours one. A point that fails is kept as a failure and the others go on.
/// @throws Interrupted when `progress` returned false; what is done stays in the journal. InputError when an input
///         changed meanwhile, or the journal holds a damaged line of one of the points
SweepResult run_sweep(const Sweep& sweep, Journal& journal, const RunProgress& progress = {});

/// The same with a result file and, beside it, the journal `<file>.points.jsonl`. Started again it goes on where it
/// stopped; a changed program, mesh, path or value runs its points anew.
SweepResult run_sweep_to_file(const Sweep& sweep, const std::filesystem::path& file,
                              const std::vector<std::string>& argv, const RunProgress& progress = {});

/// `<file>.points.jsonl`
std::filesystem::path journal_of(const std::filesystem::path& file);

}  // namespace lmdbench
