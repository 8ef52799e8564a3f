// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/build/polar_extremes.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace lmdbench::polar {

namespace {

/// Constraints at a smaller sine to the edge constrain nothing: where two normals cancel, the outer
/// side is rounding, in any direction.
constexpr double LEAST_SINE = 0.9;
/// Looser constraints (a sine) are dropped: caps of needle-like triangles get wider, never wrong.
constexpr double LARGEST_SLACK = 0.1;
/// Lower triangles, relative to their length, constrain nothing: their height is rounding.
constexpr double LEAST_HEIGHT = 1e-12;

/// An end of a chain's arc is off by its slack, and off the plane square to the chain by less than
/// half of PARALLEL_SLACK and POLAR_SLACK more: together by less than so many slacks.
constexpr double SPREAD_OF_SLACK = 1.25;
/// Edges that bend by more (a sine) are decided without constraints.
constexpr double CLEAR_BEND = 1e-3;
/// Edges of triangles of more than so many heights in length need the constraints too.
constexpr double FLAT = 10.0;

/// Slack of a triangle's constraint. The definition compares n . (x - p) with |x - p|, which is up
/// to the triangle's size, while the constraint's n . (x - p) is of its height.
double slack_of(double size_per_height) {
  return PARALLEL_SLACK + POLAR_SLACK * 2.0 * size_per_height;
}

std::int32_t opposite_corner(const Surface& surface, std::int32_t triangle,
                             const std::array<std::int32_t, 2>& ends) {
  const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(triangle)];
  return *std::find_if(corners.begin(), corners.end() - 1,
                       [&](std::int32_t corner) { return corner != ends[0] && corner != ends[1]; });
}

/// Most edges: two triangles that agree on orientation, neither flat, and a bend beyond all slack.
/// One without area has no normal: the outer side is that of the other alone.
///
/// Let a0 and a1 be the unit vectors across the edge into its triangles, n0 and n1 the normals,
/// theta the angle from a0 over the outer side to a1, so that a1 . n0 = sin(theta). A convex edge's
/// cone is the arc from n0 to n1. A reflex edge's would be the arc of the inner normals, which is
/// asin(sin(theta / 2)) and more away from the outer side; sin(theta / 2) >= |sin(theta)| / 2 is
/// more than CLEAR_BEND / 2 = 5e-4, and no slack is more than 9.2e-5: it is empty.
struct ClearEdge {
  bool is_clear = false;
  bool is_convex = false;
  double size_per_height = 0.0;  ///< The larger of the two triangles'.

  ClearEdge(const Surface& surface, std::int32_t edge, const Vec3& along, double least_wing) {
    const auto e = static_cast<std::size_t>(edge);
    if (surface.edge_is_boundary[e] || surface.edge_is_non_manifold[e]) return;
    const auto& ends = surface.adjacency.edges[e];
    const auto triangles = surface.adjacency.edge_triangles[edge];
    const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(ends[0])];
    const double squared_length = along.squaredNorm();
    const Vec3& normal = surface.face_normals[static_cast<std::size_t>(triangles[0])];
    double rise = 0.0, squared_height = 0.0, squared_flatness = 0.0;
    for (const std::int32_t triangle : {triangles[0], triangles[1]}) {
      if (surface.face_normals[static_cast<std::size_t>(triangle)].isZero(0.0)) return;
      const std::int32_t corner = opposite_corner(surface, triangle, ends);
      const Vec3 to_corner = surface.mesh.vertices[static_cast<std::size_t>(corner)] - p;
      rise = normal.dot(to_corner);
      squared_height = along.cross(to_corner).squaredNorm() / squared_length;
      const double squared_size = 2.0 * (squared_length + to_corner.squaredNorm());
      // Written so that a height or length of zero is flat.
      if (!(FLAT * FLAT * squared_height > squared_size) || squared_height <= least_wing * least_wing) return;
      squared_flatness = std::max(squared_flatness, squared_size / squared_height);
    }
    is_clear = rise * rise > CLEAR_BEND * CLEAR_BEND * squared_height;
    is_convex = rise < 0.0;
    size_per_height = std::sqrt(squared_flatness);
  }
};

/// The cone of directions square to the edge that satisfy the constraints: an arc, whose ends are
/// square to constraints. All directions where nothing constrains them.
/// @param along  unit
std::optional<PolarCap> cap_of_arc(const Vec3& along, Scratch& work) {
  std::erase_if(work.constraints, [&](const Constraint& constraint) {
    return along.cross(constraint.direction).squaredNorm() < LEAST_SINE * LEAST_SINE;
  });
  if (work.constraints.empty()) return PolarCap{};
  for (const Constraint& constraint : work.constraints)
    work.extremes.slack = std::max(work.extremes.slack, SPREAD_OF_SLACK * constraint.slack);
  for (std::size_t k = 0; k < work.constraints.size(); ++k) {
    const Vec3 end = along.cross(work.constraints[k].direction).normalized();
    for (const Vec3& candidate : {end, Vec3(-end)})
      if (satisfies(work.constraints, candidate, k, NONE, work.constraints[k].slack))
        work.extremes.directions.push_back(candidate);
  }
  return cap_around(work.extremes);
}

/// Of an edge with its two triangles, or more or fewer.
std::optional<PolarCap> cap_of_edge(const Surface& surface, std::int32_t edge, Vec3 along, double least_wing,
                                    Scratch& work) {
  const ClearEdge clear(surface, edge, along, least_wing);
  if (clear.is_clear) {
    if (!clear.is_convex) return std::nullopt;
    for (const std::int32_t triangle : surface.adjacency.edge_triangles[edge])
      work.extremes.directions.push_back(surface.face_normals[static_cast<std::size_t>(triangle)]);
    work.extremes.slack = SPREAD_OF_SLACK * slack_of(clear.size_per_height);
    return cap_around(work.extremes);
  }
  const auto& ends = surface.adjacency.edges[static_cast<std::size_t>(edge)];
  const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(ends[0])];
  const double length = along.norm();
  along /= length;

  for (const std::int32_t triangle : surface.adjacency.edge_triangles[edge]) {
    for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(triangle)]) {
      if (corner == ends[0] || corner == ends[1]) continue;
      const Vec3 to_corner = surface.mesh.vertices[static_cast<std::size_t>(corner)] - p;
      const Vec3 across = to_corner - along.dot(to_corner) * along;
      const double height = across.norm();
      const double size = length + to_corner.norm();
      if (!(height > LEAST_HEIGHT * size) || height <= least_wing) continue;
      const double slack = slack_of(size / height);
      if (slack < LARGEST_SLACK) work.constraints.push_back({across / height, slack});
    }
  }
  if (surface.has_outer_side({FeatureKind::EDGE, edge}))
    work.constraints.push_back({-surface.pseudo_normal({FeatureKind::EDGE, edge}), PARALLEL_SLACK});
  return cap_of_arc(along, work);
}

/// Of a chain of several edges or between regions, from its wings and its regions' normals.
std::optional<PolarCap> cap_of_chain(const Surface& surface, const ShapeComplex& shape, std::int32_t chain,
                                     const Vec3& along, double least_wing, Scratch& work) {
  // Of a triangle without area the wing is rounding.
  shape.for_each_chain_wing(surface, chain, [&](const Vec3& wing) {
    const double depth = wing.norm();
    if (depth > least_wing) work.constraints.push_back({wing / depth, PARALLEL_SLACK});
    return true;
  });
  if (const Vec3 outer = shape.outer_side(surface, {FeatureKind::EDGE, chain}); !outer.isZero(0.0)) {
    std::vector<std::int32_t> regions;
    shape.append_carriers(surface, {FeatureKind::EDGE, chain}, regions);
    if (regions.size() == 2 && regions[0] >= 0 && work.constraints.size() == 2) {
      const auto normal = [&](std::size_t k) -> const Vec3& {
        return shape.regions.planes[static_cast<std::size_t>(regions[k])].normal;
      };
      // Of a normal against the other region's wing; its own is square to it, so order does not
      // matter.
      const double rise = normal(0).dot(work.constraints[0].direction + work.constraints[1].direction);
      if (rise > CLEAR_BEND) return std::nullopt;
      if (rise < -CLEAR_BEND) {
        work.extremes.directions = {normal(0), normal(1)};
        work.extremes.slack = SPREAD_OF_SLACK * PARALLEL_SLACK;
        return cap_around(work.extremes);
      }
    }
    work.constraints.push_back({-outer, PARALLEL_SLACK});
  }
  return cap_of_arc(along.normalized(), work);
}

}  // namespace

std::optional<PolarCap> edge_cap(const Surface& surface, std::int32_t edge, const ShapeComplex* shape) {
  const std::int32_t chain = shape != nullptr ? shape->chain_of(edge) : -1;
  const bool is_plain = shape == nullptr || shape->is_plain_chain(surface, chain);
  const Segment line = surface.mesh.segment(is_plain ? surface.adjacency.edges[static_cast<std::size_t>(edge)]
                                                     : shape->ends_of_chain(chain));
  const Vec3 along = line[1] - line[0];
  const double squared_length = along.squaredNorm();
  if (!(squared_length > 0.0)) return std::nullopt;
  const double least_wing = shape != nullptr ? LEAST_WING * shape->regions.extent : 0.0;
  // Rounding turns its product with another line by more than the slack.
  if (squared_length <= least_wing * least_wing) return PolarCap{};
  return is_plain ? cap_of_edge(surface, edge, along, least_wing, scratch())
                  : cap_of_chain(surface, *shape, chain, along, least_wing, scratch());
}

}  // namespace lmdbench::polar
