// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace lmdbench::experiments {

/// Something to be timed at each of a list of poses.
struct TimedTask {
  std::string name;
  std::function<void(std::size_t pose)> run;
  std::function<void(std::size_t pose)> prepare = {};  ///< Goes before each run, not timed; may be empty.
};

/// Processor time [s] of the calling thread, so that other programs on the machine
/// count as little as they can.
double thread_seconds();

/// Processor time [s] of all threads of the program.
double process_seconds();

/// Writes 64 MB that nobody reads, so that what comes next finds the caches full of others' data.
void fill_caches();

/// Exponent of the power law that fits best: the slope of log(values) over log(counts) by least squares.
/// @pre as many of the one as of the other, all above 0, two counts that differ
double log_slope(const std::vector<double>& counts, const std::vector<double>& values);

/// seconds[task][pose]: the median of `repetitions` runs. All tasks run at a pose before the next
/// pose comes, in an order that rotates, so drifts of the machine meet every task alike. One
/// unrecorded run of everything goes first.
std::vector<std::vector<double>> time_interleaved(const std::vector<TimedTask>& tasks, std::size_t pose_count,
                                                  std::size_t repetitions);

}  // namespace lmdbench::experiments
