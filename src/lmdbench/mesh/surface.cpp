// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/triangle_normal.h>

#include <numeric>

namespace lmdbench {

namespace {

// Number of times that a triangle runs along the edge from its smaller to its larger vertex, minus the
// reverse.
int direction_on_edge(const TriangleMesh& mesh, std::int32_t triangle,
                      const std::array<std::int32_t, 2>& edge) {
  const auto& corners = mesh.triangles[static_cast<std::size_t>(triangle)];
  int direction = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t tail = corners[k], head = corners[(k + 1) % 3];
    if (tail == edge[0] && head == edge[1]) ++direction;
    if (tail == edge[1] && head == edge[0]) --direction;
  }
  return direction;
}

void derive_face_normals(Surface& surface) {
  const auto triangle_count = static_cast<std::int32_t>(surface.mesh.triangles.size());
  surface.face_normals.reserve(static_cast<std::size_t>(triangle_count));
  for (std::int32_t t = 0; t < triangle_count; ++t)
    surface.face_normals.push_back(triangle_normal(surface.mesh.triangle(t)));
}

void derive_edges(Surface& surface) {
  const Adjacency& adjacency = surface.adjacency;
  const std::size_t edge_count = adjacency.edges.size();
  surface.edge_pseudo_normals.assign(edge_count, Vec3::Zero());
  surface.edge_is_boundary.assign(edge_count, false);
  surface.edge_is_non_manifold.assign(edge_count, false);
  surface.vertex_is_boundary.assign(surface.mesh.vertices.size(), false);
  for (std::size_t e = 0; e < edge_count; ++e) {
    const auto triangles = adjacency.edge_triangles[static_cast<std::int32_t>(e)];
    int balance = 0;
    for (const std::int32_t t : triangles) {
      surface.edge_pseudo_normals[e] += surface.face_normals[static_cast<std::size_t>(t)];
      balance += direction_on_edge(surface.mesh, t, adjacency.edges[e]);
    }
    surface.edge_pseudo_normals[e].stableNormalize();
    surface.edge_is_boundary[e] = triangles.size() == 1;
    surface.edge_is_non_manifold[e] = triangles.size() > 2 || (triangles.size() == 2 && balance != 0);
    if (surface.edge_is_boundary[e])
      for (const std::int32_t vertex : adjacency.edges[e])
        surface.vertex_is_boundary[static_cast<std::size_t>(vertex)] = true;
  }
}

void derive_vertex_pseudo_normals(Surface& surface) {
  surface.vertex_pseudo_normals.assign(surface.mesh.vertices.size(), Vec3::Zero());
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    if (surface.face_normals[t].isZero(0.0)) continue;
    const Triangle corners = surface.mesh.triangle(static_cast<std::int32_t>(t));
    for (int k = 0; k < 3; ++k) {
      const auto vertex = static_cast<std::size_t>(surface.mesh.triangles[t][static_cast<std::size_t>(k)]);
      surface.vertex_pseudo_normals[vertex] += corner_angle(corners, k) * surface.face_normals[t];
    }
  }
  for (Vec3& normal : surface.vertex_pseudo_normals) normal.stableNormalize();
}

}  // namespace

FeatureId Surface::feature_of(std::int32_t triangle, TriangleFeature part) const {
  const auto t = static_cast<std::size_t>(triangle);
  const auto k = static_cast<std::size_t>(local_index(part));
  if (is_vertex(part)) return {FeatureKind::VERTEX, mesh.triangles[t][k]};
  if (is_edge(part)) return {FeatureKind::EDGE, adjacency.triangle_edges[t][k]};
  return {FeatureKind::FACE, triangle};
}

std::span<const std::int32_t> Surface::incident_triangles(const FeatureId& feature) const {
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return adjacency.vertex_triangles[feature.index];
    case FeatureKind::EDGE:
      return adjacency.edge_triangles[feature.index];
    case FeatureKind::FACE:
      break;
  }
  return {face_rows_.data() + feature.index, 1};
}

const Vec3& Surface::pseudo_normal(const FeatureId& feature) const {
  const auto i = static_cast<std::size_t>(feature.index);
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return vertex_pseudo_normals[i];
    case FeatureKind::EDGE:
      return edge_pseudo_normals[i];
    case FeatureKind::FACE:
      break;
  }
  return face_normals[i];
}

bool Surface::is_boundary(const FeatureId& feature) const {
  const auto i = static_cast<std::size_t>(feature.index);
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return vertex_is_boundary[i];
    case FeatureKind::EDGE:
      return edge_is_boundary[i];
    case FeatureKind::FACE:
      break;
  }
  return false;
}

Surface build_surface(TriangleMesh mesh) {
  Surface surface;
  surface.mesh = std::move(mesh);
  surface.adjacency = build_adjacency(surface.mesh);
  derive_face_normals(surface);
  derive_edges(surface);
  derive_vertex_pseudo_normals(surface);
  surface.face_rows_.resize(surface.mesh.triangles.size());
  std::iota(surface.face_rows_.begin(), surface.face_rows_.end(), 0);
  return surface;
}

}  // namespace lmdbench
