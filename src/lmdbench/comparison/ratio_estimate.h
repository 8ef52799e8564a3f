// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

namespace lmdbench {

/// By how much a candidate's times differ from a base's, from one time a process.
struct RatioEstimate {
  /// Median over all pairings of candidate / base (Hodges and Lehmann's shift of the logarithms).
  double ratio = 1.0;
  double low = 0.0;   ///< The true ratio lies below this with a probability of at most INTERVAL_ERROR,
  double high = 0.0;  ///< and above this likewise.
  double alarm_low =
      0.0;  ///< The same for the error that a false alarm may have: a low above 1 is a slowdown,
  double alarm_high = 0.0;  ///< a high below 1 the contrary.
  double detectable = 0.0;  ///< Smallest relative change that these samples could tell from none, e.g. 0.03.
  /// False where the processes are too few for a rank test to reach the error of an alarm: the interval of an alarm, and of
  /// fewer still the other one too, is then all pairings and SINGLE_PROCESS_FACTOR beyond.
  bool alarm_by_ranks = false;
  bool interval_by_ranks = false;
};

/// Either end of the reported interval. Also the probability that a slowdown of the least effect is taken for "same": that
/// needs no share for every stage, since all stages must be within the least effect and the slow one alone would have to
/// fail.
inline constexpr double INTERVAL_ERROR = 0.05;
/// What one process a side may show: a process as a whole is slowed by its neighbours on the machine, its share of the
/// caches, its place in memory and the frequency of the moment, up to this factor without any change of the program. The
/// number is ours: the largest that the project saw on shared machines is 1.5.
inline constexpr double SINGLE_PROCESS_FACTOR = 2.0;
/// One interruption of a process weighs more than a whole stage that is shorter than this [s]; the number is ours: two runs of
/// 60 frames beside a compiler differed by 3.8 in a stage of microseconds.
inline constexpr double SINGLE_PROCESS_SECONDS = 5e-4;

/// Intervals of the exact rank test (`rank_interval.h`), so their errors are known without any assumption about the noise
/// but that it is alike on both sides.
/// @param base  one time a process [s], at least one, all positive; likewise candidate
/// @param error probability of a false alarm on either side, in (0, 0.5)
RatioEstimate estimate_ratio(std::span<const double> base, std::span<const double> candidate, double error);

/// Processes a side that would end in a verdict with this noise, were `estimate.ratio` the truth: intervals shrink with the
/// root of the number of processes. More than `processes`, and enough for the rank test to reach `error`. At most 10000.
/// @param processes of the smaller side
std::size_t processes_needed(const RatioEstimate& estimate, std::size_t processes, double least_effect,
                             double error);

}  // namespace lmdbench
