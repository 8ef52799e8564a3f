// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/cone.h>
#include <lmdbench/geometry/sphere.h>
#include <lmdbench/geometry/types.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace lmdbench {
namespace {

/// Radians added to a half angle: a unit vector and an angle carry a few epsilons of rounding each.
constexpr double CONE_WIDENING = 8.0 * std::numeric_limits<double>::epsilon();

Cone cone_of_angle(const Vec3& axis, double half_angle) {
  LMDBENCH_EXPECTS(is_unit(axis), "an axis that was not normalised");
  LMDBENCH_EXPECTS(half_angle >= 0.0, "an angle of two directions is none below zero, or not a number");
  const double widened = half_angle + CONE_WIDENING;
  if (!(widened < std::numbers::pi)) return {};
  return {axis, std::cos(widened), std::sin(widened)};
}

}  // namespace

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double Cone::half_angle() const {
  return is_all_directions() ? std::numbers::pi : std::atan2(sine, cosine);
}

bool Cone::contains(const Vec3& unit_direction) const {
  LMDBENCH_EXPECTS(is_unit(unit_direction), "a direction that was not normalised");
  return is_all_directions() || angle_between(axis, unit_direction) <= half_angle();
}

Cone cone_of_directions(std::span<const Vec3> unit_directions) {
  LMDBENCH_EXPECTS(std::ranges::all_of(unit_directions, is_unit_or_zero),
                   "a direction that was not normalised");
  std::vector<Vec3> tips;
  tips.reserve(unit_directions.size());
  for (const Vec3& direction : unit_directions) {
    if (!direction.isZero(0.0)) tips.push_back(direction);
  }
  if (tips.empty()) return {};
  // A plane cuts the unit sphere in a cap, so the smallest ball of the tips is centred on the axis
  // of the smallest cap that holds them if that cap is less than half the sphere. Otherwise the
  // centre is near the origin.
  const Vec3 centre = bounding_sphere(tips).centre;
  const double length = centre.norm();
  if (!(length > 0.0)) return {};
  const Vec3 axis = centre / length;
  double half_angle = 0.0;
  for (const Vec3& tip : tips) half_angle = std::max(half_angle, angle_between(axis, tip));
  return cone_of_angle(axis, half_angle);
}

Cone convex_cone_of_directions(std::span<const Vec3> unit_directions) {
  const Cone cone = cone_of_directions(unit_directions);
  return cone.cosine > 0.0 ? cone : Cone{};
}

Cone merge_cones(const Cone& a, const Cone& b) {
  LMDBENCH_EXPECTS(a.sine >= 0.0 && b.sine >= 0.0,
                   "a cone that was not made by these functions: sine and cosine belong to one half angle");
  if (a.is_all_directions() || b.is_all_directions()) return {};
  const double phi_a = a.half_angle();
  const double phi_b = b.half_angle();
  const double between = angle_between(a.axis, b.axis);
  if (between + phi_b <= phi_a) return a;
  if (between + phi_a <= phi_b) return b;
  const double half_angle = 0.5 * (between + phi_a + phi_b);
  if (half_angle + CONE_WIDENING >= std::numbers::pi) return {};
  // Turn a's axis towards b's by (half_angle - phi_a); opposite axes may turn either way.
  Vec3 sideways = b.axis - a.axis.dot(b.axis) * a.axis;
  if (!(sideways.norm() > std::numeric_limits<double>::epsilon())) sideways = a.axis.unitOrthogonal();
  sideways = (sideways - a.axis.dot(sideways) * a.axis).normalized();
  const double turn = half_angle - phi_a;
  const Vec3 axis = (std::cos(turn) * a.axis + std::sin(turn) * sideways).normalized();
  // Measured again from the rounded axis, so that both cones stay inside.
  const double needed = std::max(angle_between(axis, a.axis) + phi_a, angle_between(axis, b.axis) + phi_b);
  return cone_of_angle(axis, needed);
}

}  // namespace lmdbench
