// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/comparison/ratio_estimate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

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
  // ways[k][u]: choices of k of the places so far with u values of the other sample before them. As
  // doubles: the numbers outgrow integers, and only their share of all is used.
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

namespace {

constexpr double MOST_PROCESSES = 10000.0;

std::vector<double> logarithms(std::span<const double> values) {
  std::vector<double> result;
  result.reserve(values.size());
  for (const double value : values) result.push_back(std::log(value));
  return result;
}

/// Both ends of the interval. Too few processes for ranks say nothing: a neighbour on the machine
/// slows a whole process, by any factor.
std::pair<double, double> ends_of(const Pairings& pairings, std::size_t bound) {
  if (bound == 0) return {0.0, std::numeric_limits<double>::infinity()};
  return {std::exp(pairings.low(bound)), std::exp(pairings.high(bound))};
}

}  // namespace

RatioEstimate estimate_ratio(std::span<const double> base, std::span<const double> candidate, double error) {
  const Pairings pairings(logarithms(base), logarithms(candidate));
  // A neighbour may have slowed a single process, and no number on the other side can show that.
  const bool replicated = std::min(base.size(), candidate.size()) > 1;
  const std::size_t bound = replicated ? rank_bound(base.size(), candidate.size(), INTERVAL_ERROR) : 0;
  const std::size_t alarm_bound = replicated ? rank_bound(base.size(), candidate.size(), error) : 0;
  RatioEstimate estimate;
  estimate.ratio = std::exp(pairings.shift());
  std::tie(estimate.low, estimate.high) = ends_of(pairings, bound);
  std::tie(estimate.alarm_low, estimate.alarm_high) = ends_of(pairings, alarm_bound);
  estimate.detectable =
      std::max(estimate.ratio / estimate.alarm_low, estimate.alarm_high / estimate.ratio) - 1.0;
  return estimate;
}

std::size_t processes_needed(const RatioEstimate& estimate, std::size_t processes, double least_effect,
                             double error) {
  std::size_t least = processes + 1;
  while (rank_bound(least, least, error) == 0) ++least;
  if (!estimate.can_alarm()) return least;  // the noise is not known yet
  const double shift = std::abs(std::log(estimate.ratio));
  // "same": the interval ends before the least effect; "slower", "faster": the alarm's before 1.
  const double room = std::log1p(least_effect) - shift;
  const double width = std::max(estimate.ratio / estimate.low, estimate.high / estimate.ratio);
  double times = std::numeric_limits<double>::infinity();
  if (room > 0.0) times = std::log(width) / room;
  if (shift > 0.0) times = std::min(times, std::log1p(estimate.detectable) / shift);
  const double needed = std::ceil(times * times * static_cast<double>(processes));
  return std::max(least, static_cast<std::size_t>(std::min(needed, MOST_PROCESSES)));
}

}  // namespace lmdbench
