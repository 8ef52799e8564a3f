// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <algorithm>

namespace lmdbench {

/// Two triangles seen along an axis: lower bounds of their distance, below 0 where they overlap [m].
struct SlabGaps {
  double a_above_b;  ///< From the end of b to the beginning of a.
  double b_above_a;
};

/// What a look along the normal of either triangle tells before the exact distance is worth its price: spheres of long thin triangles, as CAD
/// programs write them, reach each other though the triangles' planes are far apart.
/// @param axis   unit; zero, as the normal of a triangle without area, tells nothing
/// @param extent bound of the distance of any two of their corners: what rounding is relative to [m]
inline SlabGaps slab_gaps(const Vec3& axis, const Triangle& a, const Triangle& b, double extent) {
  constexpr double ROUNDING = 1e-14;
  const auto along = [&](const Vec3& corner) { return axis.dot(corner - b[0]); };
  const double a0 = along(a[0]), a1 = along(a[1]), a2 = along(a[2]), b1 = along(b[1]), b2 = along(b[2]);
  const double slack = ROUNDING * extent;
  return {std::min({a0, a1, a2}) - std::max({0.0, b1, b2}) - slack,
          std::min({0.0, b1, b2}) - std::max({a0, a1, a2}) - slack};
}

}  // namespace lmdbench
