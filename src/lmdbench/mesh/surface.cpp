// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/parallel.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/triangle_normal.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

/// Items that one task takes at a time.
constexpr std::size_t ITEMS_A_TASK = 4096;

template <class Body>
void for_each_index(std::size_t count, Body body) {
  parallel_ranges(count, ITEMS_A_TASK, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

void derive_normals(Surface& surface) {
  const TriangleMesh& mesh = surface.mesh;
  surface.face_normals.resize(mesh.triangles.size());
  for_each_index(mesh.triangles.size(), [&](std::size_t t) {
    surface.face_normals[t] = triangle_normal(mesh.triangle(static_cast<std::int32_t>(t)));
    LMDBENCH_ENSURES(is_unit_or_zero(surface.face_normals[t]), "coordinates beyond what import lets through");
  });
  surface.vertex_pseudo_normals.resize(mesh.vertices.size());
  for_each_index(mesh.vertices.size(), [&](std::size_t v) {
    surface.vertex_pseudo_normals[v] = vertex_pseudo_normal(surface, static_cast<std::int32_t>(v));
    LMDBENCH_ENSURES(is_unit_or_zero(surface.vertex_pseudo_normals[v]),
                     "a corner angle that is not a number");
  });
}

/// The edges of a triangle that end in its corner k.
std::array<std::int32_t, 2> edges_at(const Surface& surface, std::int32_t triangle, std::size_t k) {
  const auto& edges = surface.adjacency.triangle_edges[static_cast<std::size_t>(triangle)];
  return {edges[k], edges[(k + 2) % 3]};
}

/// Walks round a vertex from triangle to triangle. False where the walk misses some, or meets an
/// edge without exactly two triangles or a triangle that names a vertex twice.
bool is_one_closed_fan(const Surface& surface, std::int32_t vertex) {
  const auto triangles = surface.adjacency.vertex_triangles[vertex];
  std::int32_t triangle = triangles.front(), edge = -1;
  for (std::size_t steps = 1; steps <= triangles.size(); ++steps) {
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(triangle)];
    const auto at_vertex = edges_at(
        surface, triangle, static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin()));
    edge = at_vertex[0] == edge ? at_vertex[1] : at_vertex[0];
    const auto beside = surface.adjacency.edge_triangles[edge];
    if (beside.size() != 2 || at_vertex[0] == at_vertex[1]) return false;
    triangle = beside[0] == triangle ? beside[1] : beside[0];
    if (triangle == triangles.front()) return steps == triangles.size();
  }
  return false;
}

/// About linear in the vertex's triangles, however many an edge has: it may have all of a mesh.
bool has_several_fans(const Surface& surface, std::int32_t vertex) {
  const auto triangles = surface.adjacency.vertex_triangles[vertex];
  if (triangles.empty() || is_one_closed_fan(surface, vertex)) return false;
  std::vector<std::pair<std::int32_t, std::size_t>> sides;  // edge there, place in `triangles`
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (surface.mesh.triangles[static_cast<std::size_t>(triangles[i])][k] == vertex)
        for (const std::int32_t edge : edges_at(surface, triangles[i], k)) sides.emplace_back(edge, i);
  std::ranges::sort(sides);
  boost::disjoint_sets_with_storage<> fans(triangles.size());
  for (std::size_t s = 1; s < sides.size(); ++s)
    if (sides[s].first == sides[s - 1].first) fans.union_set(sides[s].second, sides[s - 1].second);
  for (std::size_t i = 1; i < triangles.size(); ++i)
    if (fans.find_set(i) != fans.find_set(std::size_t{0})) return true;
  return false;
}

void derive_flags(Surface& surface) {
  const Adjacency& adjacency = surface.adjacency;
  const std::size_t edge_count = adjacency.edges.size(), vertex_count = surface.mesh.vertices.size();
  // Sides that run from the smaller vertex to the larger one, minus the others. May overflow, but
  // not with two triangles, and with more it is not used.
  std::vector<std::int8_t> balance(edge_count, 0);
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t tail = surface.mesh.triangles[t][k], head = surface.mesh.triangles[t][(k + 1) % 3];
      std::int8_t& of_edge = balance[static_cast<std::size_t>(adjacency.triangle_edges[t][k])];
      of_edge = static_cast<std::int8_t>(of_edge + (tail < head ? 1 : 0) - (head < tail ? 1 : 0));
    }
  }
  surface.edge_is_boundary.assign(edge_count, false);
  surface.edge_is_non_manifold.assign(edge_count, false);
  surface.vertex_is_boundary.assign(vertex_count, false);
  surface.vertex_has_non_manifold_edge.assign(vertex_count, false);
  for (std::size_t e = 0; e < edge_count; ++e) {
    const std::size_t triangles = adjacency.edge_triangles[static_cast<std::int32_t>(e)].size();
    if (triangles == 2 && balance[e] == 0) continue;
    const bool boundary = triangles == 1;
    // A collapsed triangle leaves the corners of others as they are.
    if (surface.is_of_collapsed(static_cast<std::int32_t>(e))) {
      surface.edge_is_boundary[e] = true;
      continue;
    }
    (boundary ? surface.edge_is_boundary : surface.edge_is_non_manifold)[e] = true;
    for (const std::int32_t vertex : adjacency.edges[e])
      (boundary ? surface.vertex_is_boundary
                : surface.vertex_has_non_manifold_edge)[static_cast<std::size_t>(vertex)] = true;
  }
  surface.vertex_has_several_fans.resize(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v)
    surface.vertex_has_several_fans[v] = has_several_fans(surface, static_cast<std::int32_t>(v));
}

/// A sum of unit normals that cancel is the rounding of their triangles, at most that of one whose
/// area is hardly told from none (ZERO_AREA_TOLERANCE): no direction. Sheets with both sides have
/// such edges and corners.
constexpr double CANCELLED = 1e-12;

Vec3 edge_pseudo_normal(const Surface& surface, std::int32_t edge) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t triangle : surface.adjacency.edge_triangles[edge])
    sum += surface.face_normals[static_cast<std::size_t>(triangle)];
  return direction_of_sum(sum, static_cast<double>(surface.adjacency.edge_triangles[edge].size()));
}

template <class T>
std::size_t bytes_of(const std::vector<T>& items) {
  return items.capacity() * sizeof(T);
}

std::size_t bytes_of(const std::vector<bool>& flags) {
  return flags.capacity() / 8;
}

}  // namespace

Vec3 direction_of_sum(const Vec3& sum, double weight) {
  return sum.norm() > CANCELLED * weight ? Vec3(sum.normalized()) : Vec3(Vec3::Zero());
}

Vec3 vertex_pseudo_normal(const Surface& surface, std::int32_t vertex) {
  Vec3 sum = Vec3::Zero();
  double angles = 0.0;
  for (const std::int32_t triangle : surface.adjacency.vertex_triangles[vertex]) {
    const auto t = static_cast<std::size_t>(triangle);
    if (surface.face_normals[t].isZero(0.0)) continue;
    const Triangle corners = surface.mesh.triangle(triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      if (surface.mesh.triangles[t][k] != vertex) continue;
      const double angle = corner_angle(corners, k);
      sum += angle * surface.face_normals[t];
      angles += angle;
    }
  }
  return direction_of_sum(sum, angles);
}

FeatureId Surface::feature_of(std::int32_t triangle, TriangleFeature part) const {
  LMDBENCH_EXPECTS(triangle >= 0 && static_cast<std::size_t>(triangle) < mesh.triangles.size(),
                   "a triangle of the other mesh");
  const auto t = static_cast<std::size_t>(triangle);
  const auto k = static_cast<std::size_t>(local_index(part));
  if (is_vertex(part)) return {FeatureKind::VERTEX, mesh.triangles[t][k]};
  if (is_edge(part)) return {FeatureKind::EDGE, adjacency.triangle_edges[t][k]};
  return {FeatureKind::FACE, triangle};
}

TriangleList Surface::incident_triangles(const FeatureId& feature) const {
  LMDBENCH_EXPECTS(feature.index >= 0, "a feature that was never set");
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return TriangleList(adjacency.vertex_triangles[feature.index]);
    case FeatureKind::EDGE:
      return TriangleList(adjacency.edge_triangles[feature.index]);
    case FeatureKind::FACE:
      break;
  }
  return TriangleList(feature.index);
}

bool Surface::holds(std::int32_t triangle, const FeatureId& feature) const {
  const auto t = static_cast<std::size_t>(triangle);
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return std::ranges::find(mesh.triangles[t], feature.index) != mesh.triangles[t].end();
    case FeatureKind::EDGE:
      return std::ranges::find(adjacency.triangle_edges[t], feature.index) !=
             adjacency.triangle_edges[t].end();
    case FeatureKind::FACE:
      break;
  }
  return feature.index == triangle;
}

bool Surface::is_of_collapsed(std::int32_t edge) const {
  return names_vertex_twice(mesh.triangles[static_cast<std::size_t>(adjacency.edge_triangles[edge].front())]);
}

Vec3 Surface::pseudo_normal(const FeatureId& feature) const {
  const auto i = static_cast<std::size_t>(feature.index);
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return vertex_normal(feature.index);
    case FeatureKind::EDGE:
      return edge_pseudo_normal(*this, feature.index);
    case FeatureKind::FACE:
      break;
  }
  return face_normals[i];
}

bool Surface::is_one_fan(const FeatureId& feature) const {
  const auto i = static_cast<std::size_t>(feature.index);
  return !is_boundary(feature) && !(feature.kind == FeatureKind::EDGE && edge_is_non_manifold[i]) &&
         !(feature.kind == FeatureKind::VERTEX &&
           (vertex_has_non_manifold_edge[i] || vertex_has_several_fans[i]));
}

bool Surface::has_outer_side(const FeatureId& feature) const {
  return is_one_fan(feature) && !pseudo_normal(feature).isZero(0.0);
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

std::size_t Surface::bytes() const {
  return bytes_of(mesh.vertices) + bytes_of(mesh.triangles) + adjacency.bytes() + bytes_of(face_normals) +
         bytes_of(vertex_pseudo_normals) + bytes_of(vertex_normal_is_stale) + bytes_of(edge_is_boundary) +
         bytes_of(vertex_is_boundary) + bytes_of(edge_is_non_manifold) +
         bytes_of(vertex_has_non_manifold_edge) + bytes_of(vertex_has_several_fans);
}

Surface build_surface(TriangleMesh mesh) {
  Surface surface;
  surface.mesh = std::move(mesh);
  surface.adjacency = build_adjacency(surface.mesh);
  const auto normals = [&] { derive_normals(surface); };
  const auto flags = [&] { derive_flags(surface); };
  if (surface.mesh.triangles.size() > ITEMS_A_TASK) {
    parallel_invoke(normals, flags);
  } else {
    normals();
    flags();
  }
  return surface;
}

}  // namespace lmdbench
