// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/rank_interval.h>
#include <lmdbench/comparison/ratio_estimate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

constexpr double MOST_PROCESSES = 10000.0;

std::vector<double> logarithms(std::span<const double> values) {
  std::vector<double> result;
  result.reserve(values.size());
  for (const double value : values) result.push_back(std::log(value));
  return result;
}

/// Both ends of the interval. So few processes that ranks give none say nothing: a neighbour on the machine slows a process
/// as a whole, and no factor bounds that.
std::pair<double, double> ends_of(const Pairings& pairings, std::size_t bound) {
  if (bound == 0) return {0.0, std::numeric_limits<double>::infinity()};
  return {std::exp(pairings.low(bound)), std::exp(pairings.high(bound))};
}

}  // namespace

RatioEstimate estimate_ratio(std::span<const double> base, std::span<const double> candidate, double error) {
  const Pairings pairings(logarithms(base), logarithms(candidate));
  // A single process may have been held up as a whole, and no number on the other side can show that.
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
  // "same" needs the interval to end before the least effect, "slower" and "faster" the alarm's to end before 1.
  const double room = std::log1p(least_effect) - shift;
  const double width = std::max(estimate.ratio / estimate.low, estimate.high / estimate.ratio);
  double times = std::numeric_limits<double>::infinity();
  if (room > 0.0) times = std::log(width) / room;
  if (shift > 0.0) times = std::min(times, std::log1p(estimate.detectable) / shift);
  const double needed = std::ceil(times * times * static_cast<double>(processes));
  return std::max(least, static_cast<std::size_t>(std::min(needed, MOST_PROCESSES)));
}

}  // namespace lmdbench
