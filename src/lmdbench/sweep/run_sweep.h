// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/run/run.h>
#include <lmdbench/sweep/journal.h>
#include <lmdbench/sweep/point_key.h>
#include <lmdbench/sweep/point_result.h>
#include <lmdbench/sweep/sweep.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
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

/// What one call of `run_points` did.
struct SweepWork {
  std::int64_t resumed_runs = 0;                ///< Of points and repetitions, those that the journal knew.
  std::map<std::size_t, std::string> failures;  ///< Points without numbers, and why.
};

/// Measures those of the points that the journal does not know. Points of one scene, path and force take turns: each repetition
/// goes through them in a new random order, so that neither a drift of the machine's speed nor what another point
/// leaves in the caches favours one. A point that fails is kept as a failure and the others go on.
/// @param by_name  whether the node is named (node_watch.h)
/// @throws Interrupted when `progress` returned false; what is done stays in the journal. InputError when an input
///         changed meanwhile
SweepWork run_points(const Sweep& sweep, const std::vector<std::size_t>& points, Journal& journal,
                     InputHashes& hashes, bool by_name, const RunProgress& progress = {});

/// What the journal holds of all points; nothing is measured.
/// @throws InputError when points are missing, or the journal holds a damaged line of one of them
SweepResult collect_points(const Sweep& sweep, const Journal& journal, InputHashes& hashes);

/// Both with a result file and, beside it, the journal `<file>.points.jsonl`. Started again it goes on where it
/// stopped; a changed program, mesh, path or value runs its points anew. What was measured apart (sweep_parts.h) counts.
SweepResult run_sweep_to_file(const Sweep& sweep, const std::filesystem::path& file,
                              const std::vector<std::string>& argv, const RunProgress& progress = {});

/// The result file of what was measured before.
/// @throws InputError naming the points that nobody has measured yet
SweepResult collect_sweep_to_file(const Sweep& sweep, const std::filesystem::path& file,
                                  const std::vector<std::string>& argv);

/// Files that a sweep reads, its own first.
std::vector<std::filesystem::path> inputs_of(const Sweep& sweep);

/// Whether the journal knows all repetitions.
bool is_finished(const Journal& journal, const std::string& key, std::int64_t repetitions);

/// `<file>.points.jsonl`
std::filesystem::path journal_of(const std::filesystem::path& file);

}  // namespace lmdbench
