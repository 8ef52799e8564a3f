// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <span>

namespace lmdbench {

/// Angle of two vectors of any lengths but 0, radians in [0, pi]. atan2 keeps full precision near 0
/// and pi; acos of the dot product loses half of it there.
double angle_between(const Vec3& a, const Vec3& b);

/// Circular cone of directions { n : angle(n, axis) <= phi }, phi in [0, pi]; pi means all
/// directions, the default, which is always safe. Cosine and sine of phi let node tests compare
/// without inverse trigonometry: cos(a + b) = cos a cos b - sin a sin b.
struct Cone {
  Vec3 axis = Vec3::UnitX();  ///< unit; any direction where the cone is all directions
  double cosine = -1.0;       ///< cos(phi)
  double sine = 0.0;          ///< sin(phi) >= 0

  bool is_all_directions() const { return cosine <= -1.0; }
  double half_angle() const;  ///< phi, radians
  /// True when the unit vector lies in the cone; no tolerance (the makers below round outwards).
  bool contains(const Vec3& unit_direction) const;
};

/// Smallest circular cone around the directions, up to rounding; perhaps a larger one where no half
/// space holds them all. Zero vectors (normals of triangles without area) are ignored; a set
/// without any direction gives all directions. Every direction is inside. The directions *between*
/// them (their conical hull) are inside only when the half angle is below 90 degrees: see
/// convex_cone_of_directions.
/// @param unit_directions #N by 3, unit or zero
Cone cone_of_directions(std::span<const Vec3> unit_directions);

/// Cone around the conical hull of the directions. Decision E1, ours: a cone of 90 degrees or more
/// does not contain the conical hull of what it was built from, so it becomes all directions.
Cone convex_cone_of_directions(std::span<const Vec3> unit_directions);

/// Smallest circular cone around two cones, rounded outwards.
Cone merge_cones(const Cone& a, const Cone& b);

}  // namespace lmdbench
