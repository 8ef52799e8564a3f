// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <span>

namespace lmdbench {

/// Angle of two vectors of any lengths but 0, radians in [0, pi]. atan2 keeps full precision near 0 and pi, where acos of
/// the dot product loses half.
double angle_between(const Vec3& a, const Vec3& b);

/// Circular cone of directions { n : angle(n, axis) <= phi }, phi in [0, pi]; pi means all directions. The
/// angle is kept as cosine and sine, so that node tests compare without inverse trigonometry: cos(a + b) =
/// cos a cos b - sin a sin b. The default is all directions, which is always safe.
struct Cone {
  Vec3 axis = Vec3::UnitX();  ///< unit; any direction where the cone is all directions
  double cosine = -1.0;       ///< cos(phi)
  double sine = 0.0;          ///< sin(phi) >= 0

  bool is_all_directions() const { return cosine <= -1.0; }
  double half_angle() const;  ///< phi, radians
  /// True when the unit vector lies in the cone; no tolerance (the makers below round outwards).
  bool contains(const Vec3& unit_direction) const;
};

/// Smallest circular cone around the directions up to rounding; for a set that no half space holds a cone
/// that holds all of them, perhaps not the smallest. Zero vectors (normals of triangles without area) are
/// ignored; a set without any direction gives all directions. Every direction is inside; the directions
/// *between* them (their conical hull) are inside only when the half angle is below 90 degrees: see
/// convex_cone_of_directions.
/// @param unit_directions #N by 3, unit or zero
Cone cone_of_directions(std::span<const Vec3> unit_directions);

/// Cone around the conical hull of the directions. Decision E1, ours: a circular cone of 90 degrees or more
/// does not contain the conical hull of what it was built from, so it becomes all directions.
Cone convex_cone_of_directions(std::span<const Vec3> unit_directions);

/// Smallest circular cone around two cones, rounded outwards.
Cone merge_cones(const Cone& a, const Cone& b);

}  // namespace lmdbench
