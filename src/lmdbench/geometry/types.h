// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross() is declared in Core and defined here

#include <array>
#include <cmath>

namespace lmdbench {

/// A point or vector of R^3; the frame is in the variable's name: `p_W` world, `p_M` moving mesh.
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Corners in counter-clockwise order seen from the outer side. A degenerate triangle is a segment
/// (collinear corners) or a point (equal corners).
using Triangle = std::array<Vec3, 3>;

/// From end 0 to end 1; a segment with equal ends is a point.
using Segment = std::array<Vec3, 2>;

/// Most difference from 1 of a unit vector's squared length: above that of a chain of rotations.
inline constexpr double UNIT_TOLERANCE = 1e-6;

/// For contracts about directions.
inline bool is_unit(const Vec3& v) {
  return std::abs(v.squaredNorm() - 1.0) <= UNIT_TOLERANCE;
}
inline bool is_unit_or_zero(const Vec3& v) {
  return is_unit(v) || v.isZero(0.0);
}

}  // namespace lmdbench
