// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/wide_bounds.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench {

namespace {

/// Axes whose sum, or whose distance across, is shorter than this give no direction to go.
constexpr double LEAST_DIRECTION = 1e-9;

double squared_sine(double cosine) {
  return std::max(0.0, 1.0 - cosine * cosine);
}

}  // namespace

PolarCap enclosing_cap(std::span<const PolarCap> caps, int steps) {
  if (caps.size() == 1) return caps[0];
  Vec3 axis = Vec3::Zero();
  for (const PolarCap& cap : caps) axis += cap.axis;
  const double length = axis.norm();
  if (!(length > LEAST_DIRECTION)) return {};
  axis /= length;

  PolarCap best;
  best.cosine = -1.0;
  for (int step = 0; step <= steps; ++step) {
    // The farthest direction of a cap is at the angle to its axis plus its half angle.
    double least = 1.0;
    const PolarCap* widest = nullptr;
    for (const PolarCap& cap : caps) {
      const double between = std::min(1.0, axis.dot(cap.axis));
      const double farthest = between * cap.cosine;
      if (farthest - cap.sine >= least) continue;  // without the root, which most need not
      const double reach = farthest - std::sqrt(squared_sine(between)) * cap.sine;
      if (reach < least) {
        least = reach;
        widest = &cap;
      }
    }
    if (least > best.cosine) {
      best.cosine = least;
      best.axis = axis;
    }
    if (widest == nullptr) break;
    const Vec3 across = widest->axis - axis.dot(widest->axis) * axis;
    const double across_length = across.norm();
    if (!(across_length > LEAST_DIRECTION)) break;
    axis = (axis + std::sqrt(squared_sine(least)) / (step + 2.0) / across_length * across).normalized();
  }
  best.cosine -= 4.0 * std::numeric_limits<double>::epsilon();
  if (!(best.cosine > 0.0)) return {};
  best.sine = std::sqrt(squared_sine(best.cosine));
  return best;
}

Vec3 disc_centre(std::span<const Vec3> points, const Vec3& axis, int steps) {
  const double squared_axis = axis.squaredNorm();
  const bool has_axis = squared_axis > 0.0;
  Vec3 low = points[0], high = points[0];
  double low_along = points[0].dot(axis), high_along = low_along;
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    const double along = p.dot(axis);
    low_along = std::min(low_along, along);
    high_along = std::max(high_along, along);
  }
  Vec3 centre = 0.5 * (low + high);
  if (has_axis) centre += (0.5 * (low_along + high_along) - centre.dot(axis)) / squared_axis * axis;
  if (steps == 0) return centre;

  Vec3 best = centre;
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step <= steps; ++step) {
    double farthest = -1.0;
    const Vec3* far = nullptr;
    for (const Vec3& p : points) {
      const double squared = (p - centre).squaredNorm();
      if (squared > farthest) {
        farthest = squared;
        far = &p;
      }
    }
    if (farthest < least) {
      least = farthest;
      best = centre;
    }
    Vec3 move = *far - centre;
    if (has_axis) move -= move.dot(axis) / squared_axis * axis;
    centre += 0.5 / (step + 2.0) * move;
  }
  return best;
}

}  // namespace lmdbench
