// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <span>

namespace lmdbench {

/// The points x with normal . (x - point) = 0; `normal` is a unit vector on the outer side.
struct Plane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero();

  double height(const Vec3& x) const { return normal.dot(x - point); }
};

/// A plane through points, and how well they determine it.
struct FittedPlane {
  Plane plane;
  double breadth = 0.0;  ///< Standard deviation of the points across the plane's long axis [m].
};

/// Plane of least squared distance (total least squares), accurate to a few roundings of the
/// coordinates. The covariance's eigenvectors lose digits on thin strips, so the plane is turned
/// once more by the slopes of the points' heights over it.
/// @param points  at least one; points on a line or in one place give some plane through them
/// @param towards the normal is on this side
FittedPlane fit_plane(std::span<const Vec3> points, const Vec3& towards);

}  // namespace lmdbench
