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

/// Chains the segments that pairs of triangles share. A point is where an edge of one mesh pierces
/// a triangle of the other. Segments meet there because they name the same edge and triangle, not
/// because numbers are equal; who pierces whom is decided exactly, also of meshes that only touch
/// (triangle_intersection.h). So polylines of closed meshes are closed. A polyline ends at a mesh's
/// boundary, and where more than two triangles meet in an edge.
/// @param pairs  all pairs of triangles that share a point; others do no harm. Sorted here.
/// @param polylines  this body's are appended, in an order that depends on the set alone
void append_polylines(const Surface& moving, const RigidTransform& X_WM, const Surface& fixed,
                      std::vector<CrossingPair>& pairs, std::vector<IntersectionPolyline>& polylines);

}  // namespace lmdbench
