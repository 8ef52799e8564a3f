// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/parallel.h>
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/triangle_normal.h>
#include <lmdbench/shape/planar_faces.h>
#include <lmdbench/shape/shape_complex.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <numbers>

namespace lmdbench {

namespace {

/// A region that is wider at a corner has wings inside, too: its chains there bound a slope inwards
/// by rounding over their length times the cosine of half the angle.
constexpr double WIDE_ANGLE = 0.7 * std::numbers::pi;

/// Growth of a mesh that deforms before its triangles are tested again for being regions alone.
constexpr double ROOM_TO_GROW = 4.0;
/// Tolerances within which no face may start to grow there; the growth itself uses one.
constexpr double LONE_MARGIN = 2.0;
/// Triangles of one task.
constexpr std::size_t FACES_A_LOOK = 4096;

}  // namespace

ShapeComplex ShapeComplex::of(const Surface& surface) {
  ShapeComplex shape;
  shape.regions = FlatRegions::of(surface);
  shape.shapes = region_shapes(surface, shape.regions);
  const auto vertex_count = static_cast<std::int32_t>(surface.mesh.vertices.size());
  const auto chain_count = static_cast<std::int32_t>(shape.regions.straight_edges.size());
  shape.is_joined = !shape.shapes.shapes.empty() ||
                    std::ranges::any_of(shape.regions.straight_of_edge, [&](std::int32_t c) {
                      return c >= 0 && shape.regions.edges_of_straight[c].size() > 1;
                    });
  if (!shape.is_joined) return shape;
  shape.corner_row_.assign(static_cast<std::size_t>(vertex_count), -1);
  shape.chain_row_.assign(static_cast<std::size_t>(chain_count), -1);
  const auto end_row = [&](std::int32_t& row) {
    row = static_cast<std::int32_t>(shape.wing_starts_.size()) - 1;
    shape.wing_starts_.push_back(static_cast<std::int32_t>(shape.wings_.size()));
  };
  for (std::int32_t v = 0; v < vertex_count; ++v) {
    if (!shape.is_corner(v) || shape.is_plain(surface, v)) continue;
    shape.append_corner_wings(surface, v);
    end_row(shape.corner_row_[static_cast<std::size_t>(v)]);
  }
  for (std::int32_t c = 0; c < chain_count; ++c) {
    if (shape.is_plain_chain(surface, c)) continue;
    shape.append_chain_wings(surface, c);
    end_row(shape.chain_row_[static_cast<std::size_t>(c)]);
  }
  return shape;
}

void ShapeComplex::follow(const Surface& surface, const SurfaceChange& change) {
  if (keeps_features(surface, change)) {
    for (const std::int32_t face : change.faces) {
      const auto t = static_cast<std::size_t>(face);
      regions.planes[static_cast<std::size_t>(region_of(face))] = {
          surface.mesh.vertices[static_cast<std::size_t>(surface.mesh.triangles[t][0])],
          surface.face_normals[t]};
    }
    return;
  }
  if (!change.moved.empty()) {
    const std::uint32_t times = times_made_anew_ + 1;
    *this = of(surface);
    times_made_anew_ = times;
  }
  find_lone_triangles(surface);
}

void ShapeComplex::find_lone_triangles(const Surface& surface) {
  lone_up_to_ = ROOM_TO_GROW * regions.extent;
  is_lone_.assign(surface.mesh.triangles.size(), false);
  some_not_lone_ = false;
  for (std::size_t t = 0; t < is_lone_.size(); ++t) {
    is_lone_[t] = !regions.decides_region[t] &&
                  !may_join_neighbour(surface, static_cast<std::int32_t>(t), lone_tolerance());
    // A triangle without area is in no region whatever the extent.
    some_not_lone_ = some_not_lone_ || (!is_lone_[t] && !surface.face_normals[t].isZero(0.0));
  }
}

/// Whether a shape made anew would have the same features, apart from planes. Regions of several
/// triangles depend on the triangles of FlatRegions::decides_region and on the mesh's extent. A
/// triangle over whose edges no region can start to grow, from either side, is one by itself: in no
/// chain of several edges, no vertex inside a region, because its edges are not on a line.
bool ShapeComplex::keeps_features(const Surface& surface, const SurfaceChange& change) {
  if (is_lone_.empty() || change.lost_area > 0 || change.regained_area) return false;
  const double extent = largest_coordinate(surface.mesh.vertices);
  if (extent > lone_up_to_ || (some_not_lone_ && extent != regions.extent)) return false;
  std::atomic<bool> all_alone = true;
  parallel_ranges(change.faces.size(), FACES_A_LOOK, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && all_alone; ++i)
      if (!is_lone_[static_cast<std::size_t>(change.faces[i])] ||
          may_join_neighbour(surface, change.faces[i], lone_tolerance(), &change))
        all_alone = false;
  });
  if (!all_alone) return false;
  // Kept wings are those beside regions and chains of several faces and edges.
  const auto is_kept = [](const std::vector<std::int32_t>& rows, std::int32_t i) {
    return !rows.empty() && i >= 0 && rows[static_cast<std::size_t>(i)] >= 0;
  };
  for (const std::int32_t vertex : change.vertices)
    if (is_kept(corner_row_, vertex)) return false;
  for (const std::int32_t edge : change.edges)
    if (is_kept(chain_row_, chain_of(edge))) return false;
  regions.extent = extent;
  return true;
}

double ShapeComplex::lone_tolerance() const {
  return LONE_MARGIN * FLATNESS * lone_up_to_;
}

bool ShapeComplex::is_plain(const Surface& surface, std::int32_t vertex) const {
  return std::ranges::all_of(surface.adjacency.vertex_triangles[vertex], [&](std::int32_t t) {
    const std::int32_t region = region_of(t);
    return region >= 0 && shapes.of_region(region) == nullptr &&
           std::ranges::all_of(surface.adjacency.triangle_edges[static_cast<std::size_t>(t)],
                               [&](std::int32_t e) {
                                 const std::int32_t chain = chain_of(e);
                                 return chain >= 0 && regions.edges_of_straight[chain].size() == 1;
                               });
  });
}

bool ShapeComplex::is_plain_chain(const Surface& surface, std::int32_t chain) const {
  return regions.edges_of_straight[chain].size() == 1 &&
         std::ranges::all_of(surface.adjacency.edge_triangles[lead_of_chain(chain)], [&](std::int32_t t) {
           const std::int32_t region = region_of(t);
           return region < 0 || shapes.of_region(region) == nullptr;
         });
}

bool ShapeComplex::runs_along(const Surface& surface, std::int32_t chain, std::int32_t triangle) const {
  const auto way = [&](std::int32_t from, std::int32_t to) -> Vec3 {
    return surface.mesh.vertices[static_cast<std::size_t>(to)] -
           surface.mesh.vertices[static_cast<std::size_t>(from)];
  };
  const auto t = static_cast<std::size_t>(triangle);
  const auto& corners = surface.mesh.triangles[t];
  const auto& sides = surface.adjacency.triangle_edges[t];
  const auto k = static_cast<std::size_t>(std::ranges::find(sides, lead_of_chain(chain)) - sides.begin());
  LMDBENCH_EXPECTS(k < 3, "a triangle that is not beside the chain's lead");
  const auto& ends = ends_of_chain(chain);
  return way(corners[k], corners[(k + 1) % 3]).dot(way(ends[0], ends[1])) > 0.0;
}

Vec3 ShapeComplex::outer_side(const Surface& surface, const FeatureId& feature) const {
  const FeatureId lead = lead_of(feature);
  if (!surface.is_one_fan(lead)) return Vec3::Zero();
  if (lead.kind != FeatureKind::EDGE) return surface.pseudo_normal(lead);
  const auto triangles = surface.adjacency.edge_triangles[lead.index];
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t t : triangles)
    if (const std::int32_t region = region_of(t); region >= 0)
      sum += regions.planes[static_cast<std::size_t>(region)].normal;
  return direction_of_sum(sum, static_cast<double>(triangles.size()));
}

void ShapeComplex::append_corner_wings(const Surface& surface, std::int32_t vertex) {
  const auto position = [&](std::int32_t v) -> const Vec3& {
    return surface.mesh.vertices[static_cast<std::size_t>(v)];
  };
  const Vec3& p = position(vertex);
  // The other ends of chains, and of the sides of triangles without area.
  std::vector<std::int32_t> ends;
  for (const std::int32_t t : surface.adjacency.vertex_triangles[vertex]) {
    for (const std::int32_t e : surface.adjacency.triangle_edges[static_cast<std::size_t>(t)]) {
      const auto& own = surface.adjacency.edges[static_cast<std::size_t>(e)];
      if (own[0] != vertex && own[1] != vertex) continue;
      const std::int32_t chain = chain_of(e);
      const auto& whole = chain >= 0 ? ends_of_chain(chain) : own;
      const bool at_end = whole[0] == vertex || whole[1] == vertex;
      const auto& from_to = at_end ? whole : own;
      if (chain >= 0 || region_of(t) < 0) ends.push_back(from_to[0] == vertex ? from_to[1] : from_to[0]);
    }
    if (region_of(t) < 0)
      for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(t)])
        ends.push_back(corner);
  }
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (const std::int32_t end : ends)
    if (const Vec3 wing = position(end) - p; wing.squaredNorm() > 0.0) wings_.push_back(wing);
  // Without wings inside wide regions, a notch's corner would have a cone. No two neighbours are
  // more than a right angle apart: of nearly opposite wings both may be level to rounding where
  // what is between them leads down. Those across the widest triangle and all blunt ones are as
  // long as the region is deep, as chains may be short; sides are not, whose rounding would grow.
  std::vector<std::pair<std::int32_t, std::int32_t>> of_regions;  // region, triangle
  for (const std::int32_t t : surface.adjacency.vertex_triangles[vertex])
    if (region_of(t) >= 0 && shapes.of_region(region_of(t)) != nullptr)
      of_regions.emplace_back(region_of(t), t);
  std::ranges::sort(of_regions);
  for (std::size_t next = 0; next < of_regions.size();) {
    const std::int32_t region = of_regions[next].first;
    const Vec3& normal = regions.planes[static_cast<std::size_t>(region)].normal;
    double angle = 0.0, widest = 0.0;
    std::vector<Vec3> inside;
    std::vector<std::pair<double, Vec3>> across;
    for (; next < of_regions.size() && of_regions[next].first == region; ++next) {
      const std::int32_t t = of_regions[next].second;
      const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(t)];
      const auto& sides = surface.adjacency.triangle_edges[static_cast<std::size_t>(t)];
      const std::array<double, 3> angles = corner_angles(surface.mesh.triangle(t));
      for (std::size_t k = 0; k < 3; ++k) {
        if (corners[k] != vertex) continue;
        const Vec3 side = position(corners[(k + 1) % 3]) - p;
        angle += angles[k];
        if (chain_of(sides[k]) < 0) inside.push_back(side);
        widest = std::max(widest, angles[k]);
        across.emplace_back(angles[k], Eigen::AngleAxisd(0.5 * angles[k], normal) *
                                           (side - side.dot(normal) * normal).normalized());
      }
    }
    if (angle < WIDE_ANGLE) continue;
    wings_.insert(wings_.end(), inside.begin(), inside.end());
    for (const auto& [own, inwards] : across)
      if (own == widest || own > 0.5 * std::numbers::pi)
        wings_.push_back(shapes.of_region(region)->depth_along(p, inwards) * inwards);
  }
}

void ShapeComplex::append_chain_wings(const Surface& surface, std::int32_t chain) {
  const auto position = [&](std::int32_t v) -> const Vec3& {
    return surface.mesh.vertices[static_cast<std::size_t>(v)];
  };
  const auto& ends = ends_of_chain(chain);
  const Vec3& p = position(ends[0]);
  const Vec3 along = (position(ends[1]) - p).normalized();
  const std::int32_t edge = lead_of_chain(chain);
  const auto& edge_ends = surface.adjacency.edges[static_cast<std::size_t>(edge)];
  for (const std::int32_t t : surface.adjacency.edge_triangles[edge]) {
    const std::int32_t region = region_of(t);
    const RegionShape* shape = region >= 0 ? shapes.of_region(region) : nullptr;
    for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(t)]) {
      if (corner == edge_ends[0] || corner == edge_ends[1]) continue;
      const Vec3 to_corner = position(corner) - p;
      const Vec3 across = to_corner - to_corner.dot(along) * along;
      if (shape == nullptr) {
        wings_.push_back(across);
        continue;
      }
      // Of the region's plane, because a small triangle's is inaccurate: to the left of the side,
      // as the triangle's corner may be on the wrong one.
      const Vec3& n = regions.planes[static_cast<std::size_t>(region)].normal;
      const Vec3 inwards = n.cross(runs_along(surface, chain, t) ? along : Vec3(-along)).normalized();
      wings_.push_back(std::max(across.norm(), shape->depth_along(p, inwards)) * inwards);
    }
  }
}

void ShapeComplex::append_carriers(const Surface& surface, const FeatureId& feature,
                                   std::vector<std::int32_t>& carriers) const {
  if (feature.kind == FeatureKind::FACE) {
    carriers.push_back(feature.index);
    return;
  }
  const std::size_t first = carriers.size();
  for (const std::int32_t t : surface.incident_triangles(lead_of(feature)))
    carriers.push_back(region_of(t) >= 0 ? region_of(t) : -1 - t);
  const auto begin = carriers.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, carriers.end());
  carriers.erase(std::unique(begin, carriers.end()), carriers.end());
}

bool ShapeComplex::is_lead(const FeatureId& feature) const {
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return is_corner(feature.index);
    case FeatureKind::EDGE:
      return chain_of(feature.index) >= 0 && lead_of_chain(chain_of(feature.index)) == feature.index;
    case FeatureKind::FACE:
      break;
  }
  return region_of(feature.index) < 0 || lead_of_region(region_of(feature.index)) == feature.index;
}

bool ShapeComplex::is_lead_of_several(const FeatureId& feature) const {
  if (feature.kind == FeatureKind::VERTEX) return false;
  if (feature.kind == FeatureKind::EDGE) {
    const std::int32_t chain = chain_of(feature.index);
    return chain >= 0 && regions.edges_of_straight[chain].size() > 1;
  }
  const std::int32_t region = region_of(feature.index);
  return region >= 0 && shapes.of_region(region) != nullptr;
}

void ShapeComplex::append_corners(const Surface& surface, const FeatureId& lead,
                                  std::vector<std::int32_t>& corners) const {
  if (!is_lead_of_several(lead)) {
    const FeatureCorners own(surface, lead);
    corners.insert(corners.end(), own.view().begin(), own.view().end());
  } else if (lead.kind == FeatureKind::EDGE) {
    const auto& ends = ends_of_chain(chain_of(lead.index));
    corners.insert(corners.end(), ends.begin(), ends.end());
  } else {
    const auto& own = shapes.of_region(region_of(lead.index))->corners;
    corners.insert(corners.end(), own.begin(), own.end());
  }
}

std::int32_t ShapeComplex::face_at(const Surface& surface, std::int32_t region, const Vec3& p_S) const {
  const RegionShape* shape = shapes.of_region(region);
  if (shape == nullptr) return lead_of_region(region);
  const double within = NAMING_TOLERANCE * regions.extent;
  const Plane& plane = regions.planes[static_cast<std::size_t>(region)];
  const Vec3 p = p_S - plane.height(p_S) * plane.normal;
  Box2 box;
  box.add(shape->frame.flat(p));
  std::int32_t first = -1;
  for_each_face_near(region, box, within, [&](std::int32_t t) {
    if ((first < 0 || t < first) &&
        (point_triangle_distance(p, surface.mesh.triangle(t)).point - p).norm() <= within)
      first = t;
    return true;
  });
  return first >= 0 ? first : lead_of_region(region);
}

std::size_t ShapeComplex::bytes() const {
  return (corner_row_.capacity() + chain_row_.capacity() + wing_starts_.capacity()) * sizeof(std::int32_t) +
         wings_.capacity() * sizeof(Vec3);
}

}  // namespace lmdbench
