// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace lmdbench {

/// All differences candidate - base, sorted: the pairings of Mann and Whitney's two-sample rank test (1947). Their median
/// is the shift of Hodges and Lehmann (1963), and the test's acceptance region cuts an exact interval out of them (Moses
/// 1965). Nothing is assumed of the distribution but that it is the same on both sides up to the shift, so a process that
/// a neighbour held up moves the interval by one place only, however long it was held up.
class Pairings {
 public:
  /// Both samples have at least one value, all finite.
  Pairings(std::span<const double> base, std::span<const double> candidate);

  double shift() const;  ///< Their median

  /// The true shift lies below it with a probability of at most the error whose `rank_bound` is given: the `bound`-th
  /// smallest pairing. Ties widen nothing and break nothing: the probability only falls.
  double low(std::size_t bound) const;
  /// Likewise above it: the `bound`-th largest.
  double high(std::size_t bound) const;

 private:
  std::vector<double> sorted_;
};

/// Largest k such that, of `base` x `candidate` pairings of samples from one source, fewer than k are negative with a
/// probability of at most `error`; exact, by counting the orders of the pooled values. 0 where so few processes cannot
/// reach the error: then even pairings that all agree are too likely.
/// @param error in (0, 0.5)
std::size_t rank_bound(std::size_t base, std::size_t candidate, double error);

/// By how much a candidate's times differ from a base's, from one time a process.
struct RatioEstimate {
  /// Median over all pairings of candidate / base (Hodges and Lehmann's shift of the logarithms).
  double ratio = 1.0;
  /// The true ratio lies below `low` with a probability of at most INTERVAL_ERROR, above `high` likewise; 0 and infinity
  /// where the processes are too few for a rank test to reach that error (two a side) or single on a side.
  double low = 0.0;
  double high = 0.0;
  /// The same for the error that a false alarm may have: a low above 1 is a slowdown, a high below 1 the contrary.
  double alarm_low = 0.0;
  double alarm_high = 0.0;
  /// Smallest relative change that these samples could tell from none, e.g. 0.03; infinity where too few can tell any.
  double detectable = 0.0;

  bool has_interval() const { return high < std::numeric_limits<double>::infinity(); }
  bool can_alarm() const { return alarm_high < std::numeric_limits<double>::infinity(); }
};

/// Either end of the reported interval. Also the probability that a slowdown of the least effect is taken for "same": that
/// needs no share for every stage, since all stages must be within the least effect and the slow one alone would have to
/// fail.
inline constexpr double INTERVAL_ERROR = 0.05;
/// Intervals of the exact rank test (`ratio_estimate.h`), so their errors are known without any assumption about the noise
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
