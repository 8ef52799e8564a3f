// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <cmath>

namespace lmdbench {

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
