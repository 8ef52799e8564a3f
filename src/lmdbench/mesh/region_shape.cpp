// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
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
  LMDBENCH_EXPECTS(static_cast<std::size_t>(region) < regions.planes.size() && tolerance >= 0.0,
                   "a region of another mesh");
  const Plane& plane = regions.planes[static_cast<std::size_t>(region)];
  shape.frame = PlanarFrame(plane.point, plane.normal);
  const auto vertex = [&](std::int32_t v) -> const Vec3& {
    return surface.mesh.vertices[static_cast<std::size_t>(v)];
  };
  const auto triangles = regions.region_triangles[region];

  // Each straight edge of the border once for each way that triangles run along it.
  std::set<std::pair<std::int32_t, bool>> directed;
  std::vector<Box2> boxes;
  for (const std::int32_t t : triangles) {
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(t)];
    Box2& box = boxes.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      box.add(shape.frame.flat(vertex(corners[k])));
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
  for (const auto& [straight, forward] : directed) {
    const auto& ends = regions.straight_edges[static_cast<std::size_t>(straight)].ends;
    const Vec2 a = shape.frame.flat(vertex(ends[0])), b = shape.frame.flat(vertex(ends[1]));
    shape.sides.push_back(forward ? PolygonSide{a, b} : PolygonSide{b, a});
  }
  shape.pieces = convex_pieces(shape.sides, tolerance);
  std::vector<Box2> piece_boxes;
  for (const ConvexPolygon& piece : shape.pieces) piece_boxes.push_back(piece.box());
  shape.piece_grid = BoxGrid(std::move(piece_boxes));

  shape.triangle_grid = BoxGrid(std::move(boxes));
  std::vector<Vec2> outline;
  for (const std::int32_t v : shape.corners) outline.push_back(shape.frame.flat(vertex(v)));
  shape.hull = convex_hull(std::move(outline));
  return shape;
}

}  // namespace

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
