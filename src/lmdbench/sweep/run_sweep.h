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

/// Results of a sweep, point by point.
struct SweepResult {
  std::vector<PointResult> points;  ///< In the order of the sweep's.
  std::int64_t resumed_runs = 0;    ///< Points and repetitions found in the journal.
  double clock_overhead_s = 0.0;    ///< Part of every time.
  std::vector<InputFile> inputs;    ///< With hashes of the bytes used.
};

/// What one call of `run_points` did.
struct SweepWork {
  std::int64_t resumed_runs = 0;                ///< Points and repetitions found in the journal.
  std::map<std::size_t, std::string> failures;  ///< Points without numbers, and why.
};

/// Measures points that the journal lacks. Points of one scene, path and force take turns: each
/// repetition goes through them in a new random order, so that neither drift of the machine's speed
/// nor another point's caches favour one. A failed point is noted and the others continue.
/// @param by_name  whether to name the node (node_watch.h)
/// @throws Interrupted when `progress` returned false; the journal keeps finished work. InputError
/// when an input changed meanwhile
SweepWork run_points(const Sweep& sweep, const std::vector<std::size_t>& points, Journal& journal,
                     InputHashes& hashes, bool by_name, const RunProgress& progress = {});

/// Reads all points from the journal, without measuring.
/// @throws InputError when points are missing, or the journal holds a damaged line of one of them
SweepResult collect_points(const Sweep& sweep, const Journal& journal, InputHashes& hashes);

/// Both with a result file and its journal `<file>.points.jsonl`. A restart continues there; a
/// changed program, mesh, path or value repeats its points. Measured parts (sweep_parts.h) count.
SweepResult run_sweep_to_file(const Sweep& sweep, const std::filesystem::path& file,
                              const std::vector<std::string>& argv, const RunProgress& progress = {});

/// The result file of earlier measurements.
/// @throws InputError naming the points not measured yet
SweepResult collect_sweep_to_file(const Sweep& sweep, const std::filesystem::path& file,
                                  const std::vector<std::string>& argv);

/// Files that a sweep reads, its own first.
std::vector<std::filesystem::path> inputs_of(const Sweep& sweep);

/// Whether the journal has all repetitions.
bool is_finished(const Journal& journal, const std::string& key, std::int64_t repetitions);

/// `<file>.points.jsonl`
std::filesystem::path journal_of(const std::filesystem::path& file);

}  // namespace lmdbench
