// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/mesh/region_shape.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace lmdbench {

namespace {

RegionShape shape_of(const Surface& surface, const FlatRegions& regions, std::int32_t region,
                     double tolerance) {
  RegionShape shape;
  const Plane& plane = regions.planes[static_cast<std::size_t>(region)];
  shape.frame = PlanarFrame(plane.point, plane.normal);
  const auto vertex = [&](std::int32_t v) -> const Vec3& {
    return surface.mesh.vertices[static_cast<std::size_t>(v)];
  };
  const auto triangles = regions.region_triangles[region];

  // Each straight edge of the border once for each way that triangles run along it.
  std::set<std::pair<std::int32_t, bool>> directed;
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const std::int32_t t : triangles) {
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(t)];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 x = shape.frame.flat(vertex(corners[k]));
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
      const std::int32_t edge = surface.adjacency.triangle_edges[static_cast<std::size_t>(t)][k];
      const std::int32_t straight = regions.straight_of_edge[static_cast<std::size_t>(edge)];
      if (straight < 0) continue;
      const auto& ends = regions.straight_edges[static_cast<std::size_t>(straight)].ends;
      const Vec3 along = vertex(ends[1]) - vertex(ends[0]);
      directed.emplace(straight, along.dot(vertex(corners[(k + 1) % 3]) - vertex(corners[k])) > 0.0);
      shape.corners.insert(shape.corners.end(), ends.begin(), ends.end());
    }
  }
  std::sort(shape.corners.begin(), shape.corners.end());
  shape.corners.erase(std::unique(shape.corners.begin(), shape.corners.end()), shape.corners.end());
  std::vector<PolygonSide> sides;
  for (const auto& [straight, forward] : directed) {
    const auto& ends = regions.straight_edges[static_cast<std::size_t>(straight)].ends;
    const Vec2 a = shape.frame.flat(vertex(ends[0])), b = shape.frame.flat(vertex(ends[1]));
    sides.push_back(forward ? PolygonSide{a, b} : PolygonSide{b, a});
  }
  shape.pieces = convex_pieces(sides, tolerance);

  // About one triangle a cell.
  shape.low = low;
  shape.high = high;
  const Vec2 size = high - low;
  const double spacing =
      std::sqrt(std::max(1e-300, size[0] * size[1]) / static_cast<double>(triangles.size()));
  const auto cells_of = [&](double length) {
    return std::clamp(static_cast<int>(std::ceil(length / spacing)), 1, static_cast<int>(triangles.size()));
  };
  shape.columns = cells_of(size[0]);
  shape.rows = cells_of(size[1]);
  shape.cells_per_metre =
      Vec2(size[0] > 0.0 ? shape.columns / size[0] : 0.0, size[1] > 0.0 ? shape.rows / size[1] : 0.0);
  std::vector<std::pair<std::int32_t, std::int32_t>> cells;
  for (const std::int32_t t : triangles) {
    Vec2 least = high, most = low;
    for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(t)]) {
      const Vec2 x = shape.frame.flat(vertex(corner));
      least = least.cwiseMin(x);
      most = most.cwiseMax(x);
    }
    const auto [x0, y0] = shape.cell_of(least);
    const auto [x1, y1] = shape.cell_of(most);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) cells.emplace_back(y * shape.columns + x, t);
  }
  shape.cells = CsrRows(shape.columns * shape.rows, cells);
  return shape;
}

}  // namespace

std::pair<int, int> RegionShape::cell_of(const Vec2& x) const {
  const Vec2 at = (x - low).cwiseProduct(cells_per_metre);
  return {static_cast<int>(std::clamp(at[0], 0.0, columns - 1.0)),
          static_cast<int>(std::clamp(at[1], 0.0, rows - 1.0))};
}

RegionShapes region_shapes(const Surface& surface, const FlatRegions& regions) {
  RegionShapes result;
  const double tolerance = FLATNESS * largest_coordinate(surface.mesh.vertices);
  result.shape_of_region.assign(static_cast<std::size_t>(regions.region_count()), -1);
  for (std::int32_t region = 0; region < regions.region_count(); ++region) {
    if (regions.region_triangles[region].size() < 2) continue;
    result.shape_of_region[static_cast<std::size_t>(region)] =
        static_cast<std::int32_t>(result.shapes.size());
    result.shapes.push_back(shape_of(surface, regions, region, tolerance));
  }
  return result;
}

}  // namespace lmdbench
