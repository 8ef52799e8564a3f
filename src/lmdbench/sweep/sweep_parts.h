// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/sweep/run_sweep.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// A sweep that several processes measure, on one machine or many (scripts/cluster/). Each takes some points and keeps a
/// journal of its own; who collects them reads all journals. What a point's numbers are does not depend on who measured it, but
/// for its times, and of them the journal says where and beside what they were measured.
namespace lmdbench {

/// `<file>.points`, the folder of the journals of the parts of a sweep whose result is `file`.
std::filesystem::path parts_folder(const std::filesystem::path& file);

/// A journal, and what all others of the sweep hold as well: the result's own, then the parts' by name.
/// @param own which of them is written to
Journal journal_with_parts(const std::filesystem::path& own, const std::filesystem::path& file);

/// Measures points alone and leaves their entries in a journal in `parts_folder`, named by the points' keys. What any journal of
/// the sweep knows is not measured again. Two processes that are given the same points work one after the other: a job that its
/// scheduler lost sight of may still run.
/// @param points in any order, each once
/// @throws as `run_points`; Interrupted while it waits, too
SweepWork measure_part(const Sweep& sweep, const std::vector<std::size_t>& points,
                       const std::filesystem::path& file, const RunProgress& progress = {});

/// Points as JSON: an array of objects with "number", "key", "group" (a number that points of one scene share: together they
/// are measured in turns and have their truth once), "scene", "problem", "series", "method", "axes", and "done", whether all
/// repetitions are in a journal.
std::string point_list_json(const Sweep& sweep, const std::filesystem::path& file);

/// The same as lines for people.
std::string point_list_text(const Sweep& sweep, const std::filesystem::path& file);

/// "0-3,7": numbers of points, as `point_list_json` numbers them.
/// @throws UsageError naming `option` for what is no such list, names a point twice, or one that is not there
std::vector<std::size_t> parse_point_numbers(const std::string& text, std::size_t count,
                                             const std::string& option);

/// The inverse, of numbers that rise.
std::string point_numbers_text(const std::vector<std::size_t>& points);

/// What was done again, a line for each point of which more traversals began than it has repetitions: where, and how often.
std::vector<std::string> done_again(const Sweep& sweep, const std::filesystem::path& file);

}  // namespace lmdbench
