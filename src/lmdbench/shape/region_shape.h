// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/mesh/box_grid.h>
#include <lmdbench/mesh/csr_rows.h>
#include <lmdbench/shape/flat_regions.h>
#include <lmdbench/shape/polygon_sweep.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace lmdbench {

/// A flat region without its tessellation: a polygon, perhaps with holes, as convex pieces, and the
/// places of its triangles. All in the plane's own frame.
struct RegionShape {
  PlanarFrame frame{Vec3::Zero(), Vec3::UnitZ()};  ///< In the region's plane, seen against its
                                                   ///< normal; frame S.
  std::vector<PolygonSide> sides;                  ///< Of the border, or of the pieces.
  std::vector<ConvexPolygon> pieces;               ///< Side by side; together they are the region.
  BoxGrid piece_grid;                              ///< Of the pieces' boxes.
  BoxGrid side_grid;                               ///< Of the sides' boxes.
  std::vector<std::int32_t> corners;               ///< Ends of its straight edges, ascending.
  std::vector<Vec2> hull;                          ///< Of the corners, counter-clockwise.
  BoxGrid triangle_grid;                           ///< Of the triangles' boxes, in their order.
  /// It has chains or corners inside (of a fin on it, a slit), or parts of it overlap: then its
  /// border may cross itself, and `sides` are those of the pieces.
  bool has_features_inside = false;

  /// Whether a point of the plane is inside, away from every chain and corner, or outside, each by
  /// more than `within`. Nothing where only triangles tell: near the border and where pieces meet.
  /// @param within  at least the pieces' rounding, FLATNESS of the largest coordinate [m]
  std::optional<bool> clearly_holds(const Vec2& x, double within) const;
  /// Whether all points of a segment are clearly inside; false where that is not easily told.
  bool clearly_holds_segment(const Vec2& a, const Vec2& b, double within) const;
  /// How far its hull goes on from a point of the plane along a unit vector in it; frame S [m].
  double depth_along(const Vec3& p_S, const Vec3& u_S) const {
    const Vec2 axis(frame.u.dot(u_S), frame.v.dot(u_S));
    return axis.dot(farthest_along(hull, axis) - frame.flat(p_S));
  }
};

/// Shapes of the regions of more than one triangle; each takes a pass over its triangles and a
/// sweep over its border: n log n.
struct RegionShapes {
  std::vector<RegionShape> shapes;
  std::vector<std::int32_t> shape_of_region;  ///< #R; -1 for a region of one triangle.

  const RegionShape* of_region(std::int32_t region) const {
    const std::int32_t shape = shape_of_region[static_cast<std::size_t>(region)];
    return shape < 0 ? nullptr : &shapes[static_cast<std::size_t>(shape)];
  }
};

RegionShapes region_shapes(const Surface& surface, const FlatRegions& regions);

}  // namespace lmdbench
