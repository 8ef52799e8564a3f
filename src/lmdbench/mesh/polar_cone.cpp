// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/polar_cone.h>
#include <lmdbench/mesh/polar_rays.h>
#include <lmdbench/mesh/vertex_fan.h>
#include <lmdbench/mesh/vertex_neighbours.h>

#include <algorithm>

namespace lmdbench {

namespace {

const Vec3& vertex_of(const Surface& surface, std::int32_t index) {
  return surface.mesh.vertices[static_cast<std::size_t>(index)];
}

void add_direction(std::vector<Vec3>& directions, const Vec3& from, const Vec3& to) {
  const Vec3 direction = (to - from).stableNormalized();
  if (!direction.isZero(0.0)) directions.push_back(direction);
}

std::vector<Vec3> directions_from_vertex(const Surface& surface, std::int32_t vertex) {
  std::vector<Vec3> directions;
  for_each_neighbour(surface, vertex, [&](std::int32_t neighbour) {
    add_direction(directions, vertex_of(surface, vertex), vertex_of(surface, neighbour));
    return true;
  });
  return directions;
}

// Along the edge both ways, and to the third corner of every triangle. The latter is seen from the edge's end
// where it stands at the flattest angle: a tolerance on the sine then allows the most, so no direction that
// passes the test at some point of the edge is lost. Empty for an edge without length.
std::vector<Vec3> directions_from_edge(const Surface& surface, std::int32_t edge) {
  std::vector<Vec3> directions;
  const auto [tail, head] = surface.adjacency.edges[static_cast<std::size_t>(edge)];
  const Vec3& a = vertex_of(surface, tail);
  const Vec3& b = vertex_of(surface, head);
  if (a == b) return directions;
  add_direction(directions, a, b);
  add_direction(directions, b, a);
  for (const std::int32_t triangle : surface.adjacency.edge_triangles[edge]) {
    for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(triangle)]) {
      if (corner == tail || corner == head) continue;
      const Vec3& c = vertex_of(surface, corner);
      const bool farther_from_a = (c - a).squaredNorm() >= (c - b).squaredNorm();
      add_direction(directions, farther_from_a ? a : b, c);
    }
  }
  return directions;
}

std::vector<Vec3> generators(const Surface& surface, const FeatureId& feature, bool first_only) {
  if (surface.incident_triangles(feature).empty()) return {};
  if (feature.kind == FeatureKind::FACE) {
    const Vec3 normal = surface.pseudo_normal(feature);
    return normal.isZero(0.0) ? std::vector<Vec3>{} : std::vector<Vec3>{normal};
  }
  std::vector<Vec3> directions;
  if (feature.kind == FeatureKind::VERTEX) {
    directions = directions_from_vertex(surface, feature.index);
  } else {
    directions = directions_from_edge(surface, feature.index);
    if (directions.empty()) return {};
  }
  const Vec3 outer = has_outer_side(surface, feature) ? surface.pseudo_normal(feature) : Vec3::Zero();
  return polar_rays(directions, outer, POLAR_CONE_TOLERANCE, first_only);
}

}  // namespace

bool has_outer_side(const Surface& surface, const FeatureId& feature) {
  if (surface.is_boundary(feature) || surface.pseudo_normal(feature).isZero(0.0)) return false;
  if (feature.kind == FeatureKind::EDGE)
    return !surface.edge_is_non_manifold[static_cast<std::size_t>(feature.index)];
  if (feature.kind == FeatureKind::VERTEX) return !is_non_manifold_vertex(surface, feature.index);
  return true;
}

PolarCone polar_cone(const Surface& surface, const FeatureId& feature) {
  return {generators(surface, feature, false)};
}

bool has_polar_cone(const Surface& surface, const FeatureId& feature) {
  return !generators(surface, feature, true).empty();
}

std::vector<FeatureId> features_with_polar_cones(const Surface& surface) {
  std::vector<FeatureId> features;
  const auto add = [&](FeatureKind kind, std::size_t count) {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); ++i)
      if (has_polar_cone(surface, {kind, i})) features.push_back({kind, i});
  };
  add(FeatureKind::VERTEX, surface.mesh.vertices.size());
  add(FeatureKind::EDGE, surface.adjacency.edges.size());
  add(FeatureKind::FACE, surface.mesh.triangles.size());
  return features;
}

bool in_polar_cone(const Surface& surface, const FeatureId& feature, const Vec3& p_M, const Vec3& d_M,
                   double tolerance) {
  const auto triangles = surface.incident_triangles(feature);
  if (triangles.empty()) return false;
  if (feature.kind == FeatureKind::FACE && surface.pseudo_normal(feature).isZero(0.0)) return false;
  const Vec3 direction = d_M.stableNormalized();
  if (has_outer_side(surface, feature) && !(direction.dot(surface.pseudo_normal(feature)) > 0.0))
    return false;
  return std::all_of(triangles.begin(), triangles.end(), [&](std::int32_t triangle) {
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(triangle)];
    return std::all_of(corners.begin(), corners.end(), [&](std::int32_t corner) {
      if (feature.kind == FeatureKind::VERTEX && corner == feature.index) return true;
      return direction.dot((vertex_of(surface, corner) - p_M).stableNormalized()) <= tolerance;
    });
  });
}

}  // namespace lmdbench
