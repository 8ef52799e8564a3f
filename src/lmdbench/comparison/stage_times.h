// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_reader.h>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// A part of a method's work that result files time on its own.
struct TimedStage {
  std::string_view name;           ///< In reports: "search", "second tracking", ...
  std::string_view dataset;        ///< Inside the method's group, (repetition, frame or search) [s]
  std::string_view counter_group;  ///< Inside the method's group: the counters that count its work
};

/// All of them; a method without local tracking has only the last one, its whole search.
const std::vector<TimedStage>& stages();

/// Time of one process in one stage [s]: the least of every frame over the measured repetitions,
/// summed over frames. A neighbour on the machine only adds time, seldom to one frame in all
/// repetitions: between 60 processes on a busy machine, plain sums differed by 20 to 50 % (standard
/// deviation), sums of minima by 0.3 to 2.5 %. No frame is left out: a slowdown of a few shows.
/// By method label and stage name; stages that a method does not have are missing.
using StageTimes = std::map<std::string, std::map<std::string, double>>;

/// Repetitions at the start of a file that warm up; 0 where there is one alone.
std::size_t warm_up_repetitions(const ResultReader& file);

/// Measured repetitions of a file, without those that warm up.
std::size_t measured_repetitions(const ResultReader& file);

/// @param repetitions use only the first so many: a minimum over more is smaller, so files are
///   compared over as many as the shortest has
StageTimes stage_times(const ResultReader& file, std::size_t repetitions);

/// Tells whether a stage does other work, or the same at another speed, by its counters' sums:
/// "more work: node_pairs +12.5 %, leaf_pairs +3 %", or "the same work: none of its 14 counters
/// moved". The stages of the global thread share their counters.
/// @param stage name of a stage of `stages()`
std::string work_of_stage(const ResultReader& base, const ResultReader& candidate, const std::string& method,
                          const std::string& stage);

}  // namespace lmdbench
