// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/mesh/feature_corners.h>
#include <lmdbench/methods/certified/flat/flat_mesh.h>

#include <algorithm>

namespace lmdbench {

FlatMesh FlatMesh::of(const Body& body) {
  FlatMesh mesh;
  mesh.regions = &body.prepared<FlatRegions>();
  mesh.shapes = region_shapes(body.surface(), *mesh.regions);
  mesh.joins_features = !mesh.shapes.shapes.empty();
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

}  // namespace lmdbench
