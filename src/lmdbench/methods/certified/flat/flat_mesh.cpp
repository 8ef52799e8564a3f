// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/mesh/feature_corners.h>
#include <lmdbench/methods/certified/flat/flat_mesh.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {

namespace {

/// Height over a region, relative to the coordinates, up to which an edge may be in its plane: ten times what the definition
/// grants at distances of up to the coordinates (ONE_SET in flat_contacts.cpp).
constexpr double IN_PLANE = 1e-7;

}  // namespace

FlatMesh FlatMesh::of(const Body& body) {
  FlatMesh mesh;
  mesh.regions = &body.prepared<FlatRegions>();
  mesh.shapes = region_shapes(body.surface(), *mesh.regions);
  mesh.joins_features = !mesh.shapes.shapes.empty();
  const FlatRegions& regions = *mesh.regions;
  const double reach = body.surface().mesh.planar_tolerance + IN_PLANE * regions.extent;
  std::vector<std::int32_t> corners;
  for (std::int32_t region = 0; region < regions.region_count(); ++region) {
    const Vec3& n = regions.planes[static_cast<std::size_t>(region)].normal;
    corners.clear();
    mesh.append_corners(body.surface(), {FeatureKind::FACE, mesh.lead_of_region(region)}, corners);
    mesh.region_has_inward_edge.push_back(std::ranges::any_of(corners, [&](std::int32_t vertex) {
      return mesh.has_inward_edge(body.surface(), vertex, {FeatureKind::FACE, region}, n, reach);
    }));
  }
  for (std::size_t straight = 0; straight < regions.straight_edges.size(); ++straight)
    mesh.straight_has_sliver.push_back(
        std::ranges::any_of(regions.edges_of_straight[straight], [&](std::int32_t edge) {
          return std::ranges::any_of(body.surface().adjacency.edge_triangles[edge], [&](std::int32_t t) {
            return regions.region_of_triangle[static_cast<std::size_t>(t)] < 0;
          });
        }));
  return mesh;
}

bool FlatMesh::is_feature(const FeatureId& feature) const {
  const auto i = static_cast<std::size_t>(feature.index);
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return !regions->vertex_is_inside[i];
    case FeatureKind::EDGE: {
      const std::int32_t straight = regions->straight_of_edge[i];
      return straight >= 0 && lead_of_straight(straight) == feature.index;
    }
    case FeatureKind::FACE:
      break;
  }
  const std::int32_t region = regions->region_of_triangle[i];
  return region < 0 || lead_of_region(region) == feature.index;
}

bool FlatMesh::is_joined(const FeatureId& feature) const {
  const auto i = static_cast<std::size_t>(feature.index);
  if (feature.kind == FeatureKind::EDGE) {
    const std::int32_t straight = regions->straight_of_edge[i];
    return straight >= 0 && regions->edges_of_straight[straight].size() > 1;
  }
  if (feature.kind == FeatureKind::VERTEX) return false;
  const std::int32_t region = regions->region_of_triangle[i];
  return region >= 0 && shapes.of_region(region) != nullptr;
}

bool FlatMesh::is_single(const FeatureId& flat) const {
  return flat.kind == FeatureKind::FACE ? shapes.of_region(flat.index) == nullptr
                                        : regions->edges_of_straight[flat.index].size() == 1;
}

void FlatMesh::append_corners(const Surface& surface, const FeatureId& feature,
                              std::vector<std::int32_t>& corners) const {
  if (!is_joined(feature)) {
    const FeatureCorners own(surface, feature);
    corners.insert(corners.end(), own.view().begin(), own.view().end());
  } else if (feature.kind == FeatureKind::EDGE) {
    const std::int32_t straight = regions->straight_of_edge[static_cast<std::size_t>(feature.index)];
    const auto& ends = regions->straight_edges[static_cast<std::size_t>(straight)].ends;
    corners.insert(corners.end(), ends.begin(), ends.end());
  } else {
    const auto& own =
        shapes.of_region(regions->region_of_triangle[static_cast<std::size_t>(feature.index)])->corners;
    corners.insert(corners.end(), own.begin(), own.end());
  }
}

std::int32_t FlatMesh::face_at(const Surface& surface, std::int32_t region, const Vec3& p_S) const {
  const RegionShape* shape = shapes.of_region(region);
  if (shape == nullptr) return lead_of_region(region);
  const double reach = NAMING_TOLERANCE * regions->extent;
  const Plane& plane = regions->planes[static_cast<std::size_t>(region)];
  const Vec3 p = p_S - plane.height(p_S) * plane.normal;
  std::int32_t first = -1;
  shape->for_each_near(shape->frame.flat(p), shape->frame.flat(p), reach, [&](std::int32_t t) {
    if (first >= 0 && t >= first) return;
    if ((point_triangle_distance(p, surface.mesh.triangle(t)).point - p).norm() <= reach) first = t;
  });
  return first >= 0 ? first : lead_of_region(region);
}

bool FlatMesh::is_on(const Surface& surface, const FeatureId& feature, const FeatureId& flat) const {
  const auto triangles = surface.incident_triangles(feature);
  if (flat.kind == FeatureKind::FACE)
    return std::any_of(triangles.begin(), triangles.end(), [&](std::int32_t t) {
      return regions->region_of_triangle[static_cast<std::size_t>(t)] == flat.index;
    });
  if (feature.kind == FeatureKind::EDGE)
    return regions->straight_of_edge[static_cast<std::size_t>(feature.index)] == flat.index;
  if (feature.kind == FeatureKind::FACE) return false;
  return std::any_of(triangles.begin(), triangles.end(), [&](std::int32_t t) {
    const auto& edges = surface.adjacency.triangle_edges[static_cast<std::size_t>(t)];
    return std::any_of(edges.begin(), edges.end(), [&](std::int32_t e) {
      const auto& ends = surface.adjacency.edges[static_cast<std::size_t>(e)];
      return (ends[0] == feature.index || ends[1] == feature.index) &&
             regions->straight_of_edge[static_cast<std::size_t>(e)] == flat.index;
    });
  });
}

bool FlatMesh::straight_has_inward_edge(const Surface& surface, std::int32_t straight, const Vec3& n_S,
                                        double reach) const {
  const auto& ends = regions->straight_edges[static_cast<std::size_t>(straight)].ends;
  return std::ranges::any_of(ends, [&](std::int32_t vertex) {
    return has_inward_edge(surface, vertex, {FeatureKind::EDGE, straight}, n_S, reach);
  });
}

/// Whether an edge at a corner of a flat feature, and no part of it, lies in the plane square to a direction, with no face
/// round it over that plane, and the direction is not on its outer side. So only where the surface crosses itself: the
/// edge has no LMD, but makes one set of minimisers of what lies at its ends (minimiser_set.h).
/// @param n_S  unit length
/// @param reach  height that counts as none [m]
bool FlatMesh::has_inward_edge(const Surface& surface, std::int32_t vertex, const FeatureId& flat,
                               const Vec3& n_S, double reach) const {
  const auto height = [&](std::int32_t v) {
    const auto& vertices = surface.mesh.vertices;
    return n_S.dot(vertices[static_cast<std::size_t>(v)] - vertices[static_cast<std::size_t>(vertex)]);
  };
  const auto is_inward = [&](std::int32_t edge) {
    const auto& ends = surface.adjacency.edges[static_cast<std::size_t>(edge)];
    if ((ends[0] != vertex && ends[1] != vertex) ||
        std::abs(height(ends[0] == vertex ? ends[1] : ends[0])) > reach)
      return false;
    const FeatureId feature{FeatureKind::EDGE, edge};
    // As in first_order.cpp: the two faces of an edge may be folded onto each other, and have no normal together.
    if (surface.is_boundary(feature) || surface.edge_is_non_manifold[static_cast<std::size_t>(edge)] ||
        n_S.dot(surface.pseudo_normal(feature)) > 0.0 || is_on(surface, feature, flat))
      return false;
    return std::ranges::all_of(surface.adjacency.edge_triangles[edge], [&](std::int32_t t) {
      return std::ranges::all_of(surface.mesh.triangles[static_cast<std::size_t>(t)],
                                 [&](std::int32_t v) { return height(v) <= reach; });
    });
  };
  return std::ranges::any_of(surface.incident_triangles({FeatureKind::VERTEX, vertex}), [&](std::int32_t t) {
    return std::ranges::any_of(surface.adjacency.triangle_edges[static_cast<std::size_t>(t)], is_inward);
  });
}

}  // namespace lmdbench
