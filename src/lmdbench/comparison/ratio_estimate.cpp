// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/comparison/ratio_estimate.h>

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

constexpr std::size_t BOOTSTRAP_RESAMPLES = 4000;
constexpr std::uint64_t BOOTSTRAP_SEED = 20050611;
constexpr std::size_t MOST_PROCESSES = 10000;

std::vector<double> logarithms(std::span<const double> values) {
  std::vector<double> result;
  result.reserve(values.size());
  for (const double value : values) result.push_back(std::log(value));
  return result;
}

/// Median of all differences candidate - base.
double median_shift(const std::vector<double>& base, const std::vector<double>& candidate) {
  std::vector<double> shifts;
  shifts.reserve(base.size() * candidate.size());
  for (const double b : base)
    for (const double c : candidate) shifts.push_back(c - b);
  const auto middle = shifts.begin() + static_cast<std::ptrdiff_t>(shifts.size() / 2);
  std::nth_element(shifts.begin(), middle, shifts.end());
  if (shifts.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(shifts.begin(), middle)) / 2.0;
}

double squared_deviations(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return sum;
}

void resample(const std::vector<double>& from, std::mt19937_64& random, std::vector<double>& into) {
  // Not std::uniform_int_distribution, whose numbers the standard leaves open; the remainder's bias is 1e-17.
  for (double& value : into) value = from[random() % from.size()];
}

std::pair<double, double> bootstrap_interval(const std::vector<double>& base,
                                             const std::vector<double>& candidate, double error) {
  std::mt19937_64 random(BOOTSTRAP_SEED);
  std::vector<double> shifts, b(base.size()), c(candidate.size());
  shifts.reserve(BOOTSTRAP_RESAMPLES);
  for (std::size_t i = 0; i < BOOTSTRAP_RESAMPLES; ++i) {
    resample(base, random, b);
    resample(candidate, random, c);
    shifts.push_back(median_shift(b, c));
  }
  return {quantile(shifts, error), quantile(shifts, 1.0 - error)};
}

double student_quantile(std::size_t degrees_of_freedom, double error) {
  const boost::math::students_t distribution(static_cast<double>(degrees_of_freedom));
  return boost::math::quantile(boost::math::complement(distribution, error));
}

}  // namespace

RatioEstimate estimate_ratio(std::span<const double> base, std::span<const double> candidate, double error) {
  const std::vector<double> b = logarithms(base), c = logarithms(candidate);
  const double shift = median_shift(b, c);
  RatioEstimate estimate;
  estimate.ratio = std::exp(shift);
  const std::size_t count = b.size() + c.size();
  if (count == 2) {
    estimate.low = estimate.ratio / SINGLE_PROCESS_FACTOR;
    estimate.high = estimate.ratio * SINGLE_PROCESS_FACTOR;
    estimate.detectable = SINGLE_PROCESS_FACTOR - 1.0;
    return estimate;
  }
  const std::size_t degrees_of_freedom = count - 2;
  const double spread =
      std::sqrt((squared_deviations(b) + squared_deviations(c)) / static_cast<double>(degrees_of_freedom));
  const double half_width =
      student_quantile(degrees_of_freedom, error) * spread *
      std::sqrt(1.0 / static_cast<double>(b.size()) + 1.0 / static_cast<double>(c.size()));
  const auto [boot_low, boot_high] = bootstrap_interval(b, c, error);
  const double low = std::min(shift - half_width, boot_low);
  const double high = std::max(shift + half_width, boot_high);
  estimate.spread = spread;
  estimate.low = std::exp(low);
  estimate.high = std::exp(high);
  estimate.detectable = std::exp(std::max(shift - low, high - shift)) - 1.0;
  return estimate;
}

double detectable_effect(double spread, std::size_t processes, double error) {
  return std::expm1(student_quantile(2 * processes - 2, error) * spread *
                    std::sqrt(2.0 / static_cast<double>(processes)));
}

std::size_t processes_needed(double spread, double least_effect, double error) {
  for (std::size_t n = 2; n < MOST_PROCESSES; ++n)
    if (detectable_effect(spread, n, error) <= least_effect) return n;
  return MOST_PROCESSES;
}

}  // namespace lmdbench
