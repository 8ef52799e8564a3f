// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace lmdbench {

/// By how much a candidate's times differ from a base's, from one time a process.
struct RatioEstimate {
  double ratio =
      1.0;  ///< Median over all pairings of candidate / base (Hodges and Lehmann's shift of the logarithms).
  double low = 0.0;         ///< The true ratio lies below this with at most the probability asked for,
  double high = 0.0;        ///< and above this likewise.
  double detectable = 0.0;  ///< Smallest relative change that these samples could tell from none, e.g. 0.03.
  /// Standard deviation of the logarithm of one process' time, pooled over both sides; unset with one process a side,
  /// which shows nothing of it.
  std::optional<double> spread;
};

/// What one process a side may show: a process as a whole is slowed by its neighbours on the machine, its share of the
/// caches, its place in memory and the frequency of the moment, up to this factor without any change of the program. The
/// number is ours: the largest that the project saw on shared machines is 1.5.
inline constexpr double SINGLE_PROCESS_FACTOR = 2.0;
/// One interruption of a process weighs more than a whole stage that is shorter than this [s]; the number is ours: two runs of
/// 60 frames beside a compiler differed by 3.8 in a stage of microseconds.
inline constexpr double SINGLE_PROCESS_SECONDS = 5e-4;

/// The interval is the wider of two, since each is blind to something: percentiles of a bootstrap over processes (sees a
/// skewed distribution, but too narrow for a handful of processes) and Student's t with the pooled spread (right for a
/// handful, but takes the logarithms as normal). Same samples, same bits: the bootstrap's seed is fixed.
/// @param base      one time a process [s], at least one, all positive; likewise candidate
/// @param error     probability of error on either side of the interval, in (0, 0.5)
RatioEstimate estimate_ratio(std::span<const double> base, std::span<const double> candidate, double error);

/// Smallest relative change that `processes` (at least 2) a side can tell from none, with the given spread of one process.
double detectable_effect(double spread, std::size_t processes, double error);

/// Processes a side that would bring `detectable` down to `least_effect`, with the given spread of one process.
/// At most 10000.
std::size_t processes_needed(double spread, double least_effect, double error);

}  // namespace lmdbench
