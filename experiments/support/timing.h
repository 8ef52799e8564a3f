// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace lmdbench::experiments {

/// A task that is timed at each of several poses.
struct TimedTask {
  std::string name;
  std::function<void(std::size_t pose)> run;
  /// Runs before each timed run, untimed; may be empty.
  std::function<void(std::size_t pose)> prepare = {};
};

/// Processor time [s] of the calling thread, which other programs affect least.
double thread_seconds();

/// Processor time [s] of all threads of the program.
double process_seconds();

/// Writes 64 MB that nobody reads, so that the caches hold unrelated data afterwards.
void fill_caches();

/// Exponent of the best power law: slope of log(values) over log(counts) by least squares.
/// @pre as many values as counts, all above 0; at least two counts differ
double log_slope(const std::vector<double>& counts, const std::vector<double>& values);

/// seconds[task][pose]: the median of `repetitions` runs. All tasks run at a pose before the next
/// pose, in a rotating order, so that drifts of the machine affect all alike. One unrecorded run of
/// everything goes first.
std::vector<std::vector<double>> time_interleaved(const std::vector<TimedTask>& tasks, std::size_t pose_count,
                                                  std::size_t repetitions);

}  // namespace lmdbench::experiments
