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

/// Corners of a triangle in counter-clockwise order seen from the outer side. May be degenerate: a triangle
/// with collinear corners is treated as a segment, one with three equal corners as a point.
using Triangle = std::array<Vec3, 3>;

/// How far the squared length of what is called a unit vector may be from 1: above what a chain of products of rotations leaves.
inline constexpr double UNIT_TOLERANCE = 1e-6;

/// What contracts ask of directions.
inline bool is_unit(const Vec3& v) {
  return std::abs(v.squaredNorm() - 1.0) <= UNIT_TOLERANCE;
}
inline bool is_unit_or_zero(const Vec3& v) {
  return is_unit(v) || v.isZero(0.0);
}

}  // namespace lmdbench
