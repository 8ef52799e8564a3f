// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
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

}  // namespace lmdbench
