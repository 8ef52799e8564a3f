// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/build/polar_extremes.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace lmdbench::polar {

namespace {

/// A cone grows when a direction is outside by more (a difference of cosines): far below the slack
/// that is added, far above rounding.
constexpr double RIM_TOLERANCE = 1e-13;
/// An axis that comes out shorter than this is rounding.
constexpr double LEAST_AXIS = 1e-9;

/// Axis of the smallest circular cone around directions in a half space; not unit. Two or three
/// directions on its rim carry it: it is grown as a smallest circle is (E. Welzl, 1991, without the
/// shuffling: there are about five directions).
Vec3 axis_around(const std::vector<Vec3>& directions) {
  const auto outside = [](const Vec3& axis, const Vec3& rim, const Vec3& direction) {
    return axis.dot(direction) < axis.dot(rim) - RIM_TOLERANCE * axis.norm();
  };
  Vec3 axis = directions[0];
  Vec3 rim = directions[0];
  for (std::size_t i = 1; i < directions.size(); ++i) {
    if (!outside(axis, rim, directions[i])) continue;
    rim = directions[i];
    axis = directions[0] + rim;
    for (std::size_t j = 1; j < i; ++j) {
      if (!outside(axis, rim, directions[j])) continue;
      axis = directions[j] + rim;
      for (std::size_t k = 0; k < j; ++k) {
        if (!outside(axis, rim, directions[k])) continue;
        axis = (directions[j] - rim).cross(directions[k] - rim);
        if (axis.dot(rim) < 0.0) axis = -axis;
      }
    }
  }
  return axis;
}

}  // namespace

std::optional<PolarCap> cap_around(const Extremes& extremes) {
  if (extremes.directions.empty()) return std::nullopt;
  PolarCap cap;
  cap.axis = axis_around(extremes.directions);
  const double length = cap.axis.norm();
  if (!(length > LEAST_AXIS)) return PolarCap{};
  cap.axis /= length;
  // Measured, so that all directions are inside however the axis was found.
  double cosine = 1.0, squared_sine = 0.0;
  for (const Vec3& direction : extremes.directions) {
    cosine = std::min(cosine, cap.axis.dot(direction));
    squared_sine = std::max(squared_sine, cap.axis.cross(direction).squaredNorm());
  }
  // Cosine and sine of phi + slack, rounded outwards.
  const double sine = std::sqrt(squared_sine);
  cap.cosine = cosine - (sine * extremes.slack + 0.5 * extremes.slack * extremes.slack);
  cap.sine = std::min(1.0, sine + extremes.slack);
  if (!(cap.cosine > 0.0)) return PolarCap{};
  return cap;
}

Scratch& scratch() {
  thread_local Scratch instance;
  instance.constraints.clear();
  instance.extremes.directions.clear();
  instance.extremes.slack = 0.0;
  instance.extremes.wings = 0;
  return instance;
}

bool satisfies(const std::vector<Constraint>& constraints, const Vec3& direction, std::size_t i,
               std::size_t j, double extra) {
  for (std::size_t k = 0; k < constraints.size(); ++k) {
    if (k == i || k == j) continue;
    if (constraints[k].direction.dot(direction) > constraints[k].slack + extra) return false;
  }
  return true;
}

}  // namespace lmdbench::polar
