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

/// How far apart pieces may be that share a side, in tolerances: what the sweep (convex_pieces.cpp) leaves between them.
constexpr double PIECE_GAP = 8.0;

void find_neighbours(RegionShape& shape, double tolerance) {
  std::vector<Box2> boxes;
  for (const ConvexPolygon& piece : shape.pieces) boxes.push_back(piece.box());
  shape.piece_grid = BoxGrid(boxes);
  const double gap = PIECE_GAP * tolerance;
  std::vector<std::pair<std::int32_t, std::int32_t>> rows;
  std::vector<std::int32_t> near;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    near.clear();
    shape.piece_grid.for_each_near(boxes[i], gap, [&](std::int32_t j) { near.push_back(j); });
    std::ranges::sort(near);
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::int32_t j : near) {
      const auto other = static_cast<std::size_t>(j);
      if (other != i && boxes[i].comes_within(boxes[other], gap) &&
          shape.pieces[i].touches(shape.pieces[other], gap))
        rows.emplace_back(static_cast<std::int32_t>(i), j);
    }
  }
  shape.piece_neighbours = CsrRows(static_cast<std::int32_t>(shape.pieces.size()), rows);
}

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
  std::vector<PolygonSide> sides;
  for (const auto& [straight, forward] : directed) {
    const auto& ends = regions.straight_edges[static_cast<std::size_t>(straight)].ends;
    const Vec2 a = shape.frame.flat(vertex(ends[0])), b = shape.frame.flat(vertex(ends[1]));
    sides.push_back(forward ? PolygonSide{a, b} : PolygonSide{b, a});
  }
  shape.pieces = convex_pieces(sides, tolerance);

  shape.triangle_grid = BoxGrid(boxes);
  find_neighbours(shape, tolerance);
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
