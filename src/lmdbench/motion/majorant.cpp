// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/motion/majorant.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace lmdbench {
namespace {

/// The passes' shares of the limits; each adds up to 1. The first pass follows the
/// large motions and takes the speed.
struct Share {
  double speed;
  double acceleration;
};
constexpr std::array<Share, 3> PASSES = {{{0.6, 0.4}, {0.2, 0.3}, {0.2, 0.3}}};

/// Drop below a sample after `time`: braking parabola up to full speed, then a straight line. Its
/// curvature is at most the acceleration.
double cap_drop(double time, const MotionLimits& limits) {
  LMDBENCH_EXPECTS(time >= 0.0 && limits.speed > 0.0 && limits.acceleration > 0.0,
                   "limits that were not checked (path_spec.h)");
  const double time_to_full_speed = limits.speed / limits.acceleration;
  if (time <= time_to_full_speed) return 0.5 * limits.acceleration * time * time;
  return limits.speed * (time - 0.5 * time_to_full_speed);
}

/// The highest of all caps at every sample, in n log n steps: a cap falls ever faster to either
/// side, so of two caps the right one is higher from some sample on: the best never moves back.
class HighestCaps {
 public:
  HighestCaps(const std::vector<double>& samples, double time_step, const MotionLimits& limits)
      : samples_(samples), drops_(samples.size()), highest_(samples) {
    for (std::size_t i = 0; i < drops_.size(); ++i)
      drops_[i] = cap_drop(static_cast<double>(i) * time_step, limits);
    fill(0, samples.size(), 0, samples.size());
  }
  std::vector<double> take() { return std::move(highest_); }

 private:
  /// Fills [begin, end), whose highest caps have their centres in [first, last).
  void fill(std::size_t begin, std::size_t end, std::size_t first, std::size_t last) {
    if (begin == end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    std::size_t best = middle;
    for (std::size_t centre = first; centre < last; ++centre) {
      const double height = samples_[centre] - drops_[centre < middle ? middle - centre : centre - middle];
      if (height <= highest_[middle]) continue;
      highest_[middle] = height;
      best = centre;
    }
    fill(begin, middle, first, best + 1);
    fill(middle + 1, end, best, last);
  }

  const std::vector<double>& samples_;
  std::vector<double> drops_, highest_;
};

/// Smallest function above `values` with second differences up to acceleration * time_step^2.
std::vector<double> limit_speeding_up(const std::vector<double>& values, double time_step,
                                      double acceleration) {
  const auto parabola = [&](std::size_t i) {
    const double time = static_cast<double>(i) * time_step;
    return 0.5 * acceleration * time * time;
  };
  std::vector<std::size_t> hull;  // indices of the upper convex hull's corners
  const auto height = [&](std::size_t i) { return values[i] - parabola(i); };
  for (std::size_t i = 0; i < values.size(); ++i) {
    while (hull.size() >= 2) {
      const std::size_t first = hull[hull.size() - 2];
      const std::size_t middle = hull.back();
      const double chord = height(first) + (height(i) - height(first)) * static_cast<double>(middle - first) /
                                               static_cast<double>(i - first);
      if (height(middle) > chord) break;
      hull.pop_back();
    }
    hull.push_back(i);
  }
  std::vector<double> limited = values;
  for (std::size_t corner = 0; corner + 1 < hull.size(); ++corner) {
    const std::size_t first = hull[corner];
    const std::size_t last = hull[corner + 1];
    for (std::size_t i = first + 1; i < last; ++i) {
      // Chord plus parabola, with the parabola taken from the chord's ends: a/2 (t -
      // t0)(t - t1), which is <= 0.
      const double u = static_cast<double>(i - first) / static_cast<double>(last - first);
      const double chord = values[first] + (values[last] - values[first]) * u;
      const double sag = 0.5 * acceleration * static_cast<double>(i - first) * static_cast<double>(last - i) *
                         time_step * time_step;
      limited[i] = std::max(values[i], chord - sag);
    }
  }
  return limited;
}

}  // namespace

std::vector<double> bounded_majorant(const std::vector<double>& samples, double time_step,
                                     const MotionLimits& limits) {
  LMDBENCH_EXPECTS(time_step > 0.0, "a rate in place of a period, or no rate");
  std::vector<double> sum(samples.size(), 0.0);
  if (samples.empty()) return sum;
  for (const Share& share : PASSES) {
    const MotionLimits pass_limits = {.speed = share.speed * limits.speed,
                                      .acceleration = share.acceleration * limits.acceleration};
    std::vector<double> remainder(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) remainder[i] = samples[i] - sum[i];
    const std::vector<double> pass = limit_speeding_up(HighestCaps(remainder, time_step, pass_limits).take(),
                                                       time_step, pass_limits.acceleration);
    for (std::size_t i = 0; i < samples.size(); ++i) sum[i] += pass[i];
  }
  // Adding passes rounds; a sample must not end an ulp above the result.
  for (std::size_t i = 0; i < samples.size(); ++i) sum[i] = std::max(sum[i], samples[i]);
  LMDBENCH_ENSURES(std::ranges::none_of(sum, [](double value) { return std::isnan(value); }),
                   "samples that are not numbers");
  return sum;
}

}  // namespace lmdbench
