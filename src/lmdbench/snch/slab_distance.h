// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <algorithm>

namespace lmdbench {

/// Lower bounds of the distance of two triangles along an axis, below 0 where they overlap [m].
struct SlabGaps {
  double a_above_b;  ///< From the end of b to the start of a.
  double b_above_a;
};

/// Bounds along either triangle's normal, before the costly exact distance: spheres of long thin
/// triangles (CAD) reach each other though the triangles' planes are far apart.
/// @param axis   unit; zero, as the normal of a triangle without area, gives no bound
/// @param extent bound of the distance of any two of their corners, for rounding [m]
inline SlabGaps slab_gaps(const Vec3& axis, const Triangle& a, const Triangle& b, double extent) {
  constexpr double ROUNDING = 1e-14;
  const auto along = [&](const Vec3& corner) { return axis.dot(corner - b[0]); };
  const double a0 = along(a[0]), a1 = along(a[1]), a2 = along(a[2]), b1 = along(b[1]), b2 = along(b[2]);
  const double slack = ROUNDING * extent;
  return {std::min({a0, a1, a2}) - std::max({0.0, b1, b2}) - slack,
          std::min({0.0, b1, b2}) - std::max({a0, a1, a2}) - slack};
}

}  // namespace lmdbench
