// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/sweep/run_sweep.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// A sweep measured by several processes, on one machine or many (scripts/cluster/). Each takes
/// some points and has its own journal; collecting reads all of them. A point's numbers do not
/// depend on the process, except for times, for which the journal has node and load.
namespace lmdbench {

/// `<file>.points`, the folder of the journals of the parts of a sweep whose result is `file`.
std::filesystem::path parts_folder(const std::filesystem::path& file);

/// A journal that also has all other entries of the sweep: the result's, then the parts' by name.
/// @param own the one to write to
Journal journal_with_parts(const std::filesystem::path& own, const std::filesystem::path& file);

/// Measures only some points into a journal in `parts_folder`, named by the points' keys. Points in
/// any journal of the sweep are skipped. Two processes with the same points wait for each other: a
/// job that its scheduler lost may still run.
/// @param points in any order, each once
/// @throws as `run_points`; Interrupted while it waits, too
SweepWork measure_part(const Sweep& sweep, const std::vector<std::size_t>& points,
                       const std::filesystem::path& file, const RunProgress& progress = {});

/// Points as JSON: an array of objects with "number", "key", "group" (shared by points of one
/// scene, which are measured in turns with one truth), "scene", "problem", "series", "method",
/// "axes", and "done" (all repetitions are in a journal).
std::string point_list_json(const Sweep& sweep, const std::filesystem::path& file);

/// The same as lines for people.
std::string point_list_text(const Sweep& sweep, const std::filesystem::path& file);

/// Parses "0-3,7": numbers of points as in `point_list_json`.
/// @throws UsageError naming `option` for a bad list, a repeated point or a missing one
std::vector<std::size_t> parse_point_numbers(const std::string& text, std::size_t count,
                                             const std::string& option);

/// The inverse, for ascending numbers.
std::string point_numbers_text(const std::vector<std::size_t>& points);

/// A line for each point with more traversals begun than repetitions: where, and how often.
std::vector<std::string> done_again(const Sweep& sweep, const std::filesystem::path& file);

}  // namespace lmdbench
