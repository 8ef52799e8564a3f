// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/shape/region_shape.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace lmdbench {

namespace {

/// Triangles overlap where a region's triangles and pieces differ in area by more than this part.
constexpr double AREA_ROUNDING = 1e-6;

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

  // Each straight edge of the border once for each direction in which triangles run along it.
  std::set<std::pair<std::int32_t, bool>> directed;
  std::vector<Box2> boxes;
  std::vector<std::int32_t> own_corners;
  double area = 0.0;
  for (const std::int32_t t : triangles) {
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(t)];
    const Vec2 a = shape.frame.flat(vertex(corners[0])), b = shape.frame.flat(vertex(corners[1])),
               c = shape.frame.flat(vertex(corners[2]));
    area += 0.5 * std::abs(cross(b - a, c - a));
    Box2& box = boxes.emplace_back();
    for (const Vec2& corner : {a, b, c}) box.add(corner);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!regions.vertex_is_inside[static_cast<std::size_t>(corners[k])]) own_corners.push_back(corners[k]);
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
  shape.has_features_inside = std::ranges::any_of(
      own_corners, [&](std::int32_t v) { return !std::ranges::binary_search(shape.corners, v); });
  for (const auto& [straight, forward] : directed) {
    if (forward && directed.contains({straight, false})) shape.has_features_inside = true;
    const auto& ends = regions.straight_edges[static_cast<std::size_t>(straight)].ends;
    const Vec2 a = shape.frame.flat(vertex(ends[0])), b = shape.frame.flat(vertex(ends[1]));
    shape.sides.push_back(forward ? PolygonSide{a, b} : PolygonSide{b, a});
  }
  shape.pieces = convex_pieces(shape.sides, tolerance);
  std::vector<Box2> piece_boxes;
  double area_of_pieces = 0.0;
  for (const ConvexPolygon& piece : shape.pieces) {
    piece_boxes.push_back(piece.box());
    area_of_pieces += piece.measure().area;
  }
  shape.piece_grid = BoxGrid(std::move(piece_boxes));
  if (std::abs(area - area_of_pieces) > AREA_ROUNDING * area) {
    // Its sides may cross, which those of its pieces do not.
    shape.has_features_inside = true;
    shape.sides.clear();
    for (const ConvexPolygon& piece : shape.pieces) append_sides_of(piece, shape.sides);
  }
  std::vector<Box2> side_boxes;
  for (const PolygonSide& side : shape.sides) {
    Box2& box = side_boxes.emplace_back();
    box.add(side.from);
    box.add(side.to);
  }
  shape.side_grid = BoxGrid(std::move(side_boxes));

  shape.triangle_grid = BoxGrid(std::move(boxes));
  std::vector<Vec2> outline;
  for (const std::int32_t v : shape.corners) outline.push_back(shape.frame.flat(vertex(v)));
  shape.hull = convex_hull(std::move(outline));
  return shape;
}

/// True: inside a convex polygon by more than `within` of every side; false: beyond one by more.
std::optional<bool> is_clearly_in(const std::vector<Vec2>& polygon, const Vec2& x, double within) {
  bool is_clear = true;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 side = polygon[k + 1 < polygon.size() ? k + 1 : 0] - polygon[k];
    const double inwards = cross(side, x - polygon[k]);
    const bool is_near = inwards * inwards <= within * within * side.squaredNorm();
    if (!is_near && inwards < 0.0) return false;
    is_clear = is_clear && !is_near;
  }
  if (is_clear) return true;
  return std::nullopt;
}

}  // namespace

std::optional<bool> RegionShape::clearly_holds(const Vec2& x, double within) const {
  if (pieces.empty()) return std::nullopt;  // Too narrow to have any.
  Box2 box;
  box.add(x);
  bool is_near = false, is_inside = false;
  piece_grid.for_each_near(box, within, [&](std::int32_t index) {
    const std::optional<bool> in_piece =
        is_clearly_in(pieces[static_cast<std::size_t>(index)].corners, x, within);
    is_near = is_near || in_piece != false;
    is_inside = in_piece == true;
    return !is_inside;
  });
  if (!is_near) return false;
  if (is_inside && !has_features_inside) return true;
  return std::nullopt;
}

bool RegionShape::clearly_holds_segment(const Vec2& a, const Vec2& b, double within) const {
  if (!clearly_holds(a, within).value_or(false)) return false;
  if (pieces.size() == 1) return clearly_holds(b, within).value_or(false);
  // No side is near: all of it is where its first end is.
  bool is_clear = true;
  side_grid.for_each_near(a, b, within, [&](std::int32_t) { is_clear = false; });
  return is_clear;
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
