// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/mesh/csr_rows.h>
#include <lmdbench/mesh/flat_regions.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace lmdbench {

/// A flat region without its tessellation: a polygon, with holes where it has them, as convex pieces; and
/// where its triangles lie.
struct RegionShape {
  PlanarFrame frame{Vec3::Zero(), Vec3::UnitZ()};  ///< In the region's plane, seen against its
                                                   ///< normal; frame S.
  std::vector<ConvexPolygon> pieces;               ///< Side by side; together they are the region.
  std::vector<std::int32_t> corners;  ///< Vertices where straight edges of its border end, ascending.

  /// Triangles whose boxes come within `reach` of a box of the plane. Some come more than once.
  template <class Visit>
  void for_each_near(const Vec2& least, const Vec2& most, double reach, Visit&& visit) const {
    const auto [x0, y0] = cell_of(least - Vec2::Constant(reach));
    const auto [x1, y1] = cell_of(most + Vec2::Constant(reach));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        for (const std::int32_t triangle : cells[y * columns + x]) visit(triangle);
  }

  /// A grid over the region: each cell lists the triangles whose boxes meet it.
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  Vec2 cells_per_metre = Vec2::Zero();
  int columns = 1, rows = 1;
  CsrRows cells;
  /// Column and row of the cell that holds a point, or of the nearest cell.
  std::pair<int, int> cell_of(const Vec2& x) const;
};

/// Shapes of the regions of more than one triangle, each a pass over its triangles and a sweep over its
/// border: n log n of them.
struct RegionShapes {
  std::vector<RegionShape> shapes;
  std::vector<std::int32_t> shape_of_region;  ///< #R; -1 for a region of one triangle.

  const RegionShape* of_region(std::int32_t region) const {
    const std::int32_t shape = shape_of_region[static_cast<std::size_t>(region)];
    return shape < 0 ? nullptr : &shapes[static_cast<std::size_t>(shape)];
  }
};

RegionShapes region_shapes(const Surface& surface, const FlatRegions& regions);

/// A directed side of a polygon, the inside to its left.
struct PolygonSide {
  Vec2 from, to;
};

/// Cuts a polygon into convex pieces: a line sweeps upwards over its corners; between two of them the inside
/// is a row of trapezoids, and one that goes on in the next row is joined to it while the piece stays convex
/// (so a convex polygon is one piece). Sides may touch or lie on each other: what counts is how often a point
/// is wound round. Corners whose heights differ by no more than the tolerance are level, and what is between
/// them is left out.
std::vector<ConvexPolygon> convex_pieces(std::span<const PolygonSide> sides, double tolerance);

}  // namespace lmdbench
