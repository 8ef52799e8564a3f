// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/comparison/rank_interval.h>

#include <algorithm>

namespace lmdbench {

Pairings::Pairings(std::span<const double> base, std::span<const double> candidate) {
  sorted_.reserve(base.size() * candidate.size());
  for (const double b : base)
    for (const double c : candidate) sorted_.push_back(c - b);
  std::sort(sorted_.begin(), sorted_.end());
}

double Pairings::shift() const {
  return median(sorted_);
}

double Pairings::low(std::size_t bound) const {
  return sorted_[bound - 1];
}

double Pairings::high(std::size_t bound) const {
  return sorted_[sorted_.size() - bound];
}

std::size_t rank_bound(std::size_t base, std::size_t candidate, double error) {
  const std::size_t pooled = base + candidate, chosen = std::min(base, candidate);
  // An error below a half is reached in the lower half of the sums.
  const std::size_t sums = base * candidate / 2 + 1;
  // ways[k][u]: choices of k of the places so far with u values of the other sample before them, counted once for each.
  // Doubles: the numbers outgrow integers, and only their share of all is used.
  std::vector<std::vector<double>> ways(chosen + 1, std::vector<double>(sums, 0.0));
  ways[0][0] = 1.0;
  double all = 1.0;  // pooled over chosen
  for (std::size_t place = 1; place <= pooled; ++place) {
    for (std::size_t k = std::min(chosen, place); k > 0; --k)
      for (std::size_t u = place - k; u < sums; ++u) ways[k][u] += ways[k - 1][u - (place - k)];
    if (place > pooled - chosen)
      all *= static_cast<double>(place) / static_cast<double>(place - (pooled - chosen));
  }
  std::size_t bound = 0;
  for (double below = ways[chosen][0]; bound + 1 < sums && below <= error * all; ++bound)
    below += ways[chosen][bound + 1];
  return bound;
}

}  // namespace lmdbench
