// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace lmdbench {

/// All differences candidate - base, sorted: the pairings of Mann and Whitney's two-sample rank
/// test (1947). Their median is the shift of Hodges and Lehmann (1963); the test's acceptance
/// region cuts an exact interval out of them (Moses 1965). Any distribution will do, the same on
/// both sides up to the shift: a process held up, however long, moves the interval by one place.
class Pairings {
 public:
  /// Both samples have at least one value, all finite.
  Pairings(std::span<const double> base, std::span<const double> candidate);

  double shift() const;  ///< Their median

  /// The `bound`-th smallest pairing: the true shift is below it with a probability of at most the
  /// error of that `rank_bound`. Ties only lower the probability.
  double low(std::size_t bound) const;
  /// Likewise above it: the `bound`-th largest.
  double high(std::size_t bound) const;

 private:
  std::vector<double> sorted_;
};

/// Largest k such that fewer than k of `base` x `candidate` pairings of samples from one source are
/// negative with a probability of at most `error`; exact, by counting the orders of the pooled
/// values. 0 where so few processes cannot reach the error, even if all pairings agree.
/// @param error in (0, 0.5)
std::size_t rank_bound(std::size_t base, std::size_t candidate, double error);

/// Ratio of a candidate's times to a base's, from one time a process.
struct RatioEstimate {
  /// Median over all pairings of candidate / base (Hodges and Lehmann's shift of the logarithms).
  double ratio = 1.0;
  /// The true ratio is below `low` with a probability of at most INTERVAL_ERROR, above `high`
  /// likewise; 0 and infinity with too few processes for that error (two a side, or a single one).
  double low = 0.0;
  double high = 0.0;
  /// The same at the false alarm's error: a low above 1 is a slowdown, a high below 1 a speed-up.
  double alarm_low = 0.0;
  double alarm_high = 0.0;
  /// Least relative change that these samples could show, e.g. 0.03; infinity if they are too few.
  double detectable = 0.0;

  bool has_interval() const { return high < std::numeric_limits<double>::infinity(); }
  bool can_alarm() const { return alarm_high < std::numeric_limits<double>::infinity(); }
};

/// Error at either end of the reported interval, and so the probability that a slowdown of the
/// least effect counts as "same". It is not shared among stages: all must be within the least
/// effect, and the slow one alone would have to fail.
inline constexpr double INTERVAL_ERROR = 0.05;
/// Intervals of the exact rank test, with known errors for any noise that is alike on both sides.
/// @param base  one time a process [s], at least one, all positive; likewise candidate
/// @param error probability of a false alarm on either side, in (0, 0.5)
RatioEstimate estimate_ratio(std::span<const double> base, std::span<const double> candidate, double error);

/// Processes a side for a verdict with this noise, if `estimate.ratio` were true: intervals shrink
/// with their root. More than `processes`, enough for a rank test to reach `error`; at most 10000.
/// @param processes of the smaller side
std::size_t processes_needed(const RatioEstimate& estimate, std::size_t processes, double least_effect,
                             double error);

}  // namespace lmdbench
