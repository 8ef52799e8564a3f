// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/surface.h>

#include <compare>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// Two triangles that intersect.
struct CrossingPair {
  std::int32_t fixed_body, moving, fixed;
  auto operator<=>(const CrossingPair&) const = default;
};

/// A curve in which two surfaces intersect (section 4.4 of the paper).
struct IntersectionPolyline {
  std::int32_t fixed_body = 0;
  bool closed = false;       ///< Then the last point is joined to the first, which is not repeated.
  std::vector<Vec3> points;  ///< world

  double length() const;  ///< metres
};

/// Chains the segments that pairs of triangles share. A point is where an edge of one mesh pierces a triangle of the
/// other; two segments meet there because they name the same edge and triangle, not because their numbers are
/// equal, and who pierces whom is decided exactly, for meshes that only touch too (triangle_intersection.h). So on closed
/// meshes every polyline is closed, always. It ends where a mesh has a boundary, and where more than two triangles
/// meet in an edge.
/// @param pairs every pair of triangles of the two surfaces that shares a point; others do no harm. Sorted here.
/// @param polylines receives the polylines of this body at its end, in an order that depends on the set alone
void append_polylines(const Surface& moving, const RigidTransform& X_WM, const Surface& fixed,
                      std::vector<CrossingPair>& pairs, std::vector<IntersectionPolyline>& polylines);

}  // namespace lmdbench
