// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/orientation_choice.h>
#include <lmdbench/mesh/validity.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace lmdbench {

namespace {

// Disjoint sets over the vertices, by path halving.
class VertexGroups {
 public:
  explicit VertexGroups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t root(std::int32_t v) {
    auto* parent = parent_.data();
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  }
  void join(std::int32_t a, std::int32_t b) { parent_[static_cast<std::size_t>(root(a))] = root(b); }

 private:
  std::vector<std::int32_t> parent_;
};

std::int64_t count_true(const std::vector<bool>& flags) {
  return std::count(flags.begin(), flags.end(), true);
}

std::int64_t count_components(const Surface& surface) {
  VertexGroups groups(surface.mesh.vertices.size());
  for (const auto& [a, b] : surface.adjacency.edges) groups.join(a, b);
  std::int64_t count = 0;
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v) {
    const auto vertex = static_cast<std::int32_t>(v);
    if (groups.root(vertex) == vertex && !surface.adjacency.vertex_triangles[vertex].empty()) ++count;
  }
  return count;
}

std::int64_t count_boundary_loops(const Surface& surface) {
  VertexGroups groups(surface.mesh.vertices.size());
  for (std::size_t e = 0; e < surface.adjacency.edges.size(); ++e)
    if (surface.edge_is_boundary[e])
      groups.join(surface.adjacency.edges[e][0], surface.adjacency.edges[e][1]);
  std::int64_t count = 0;
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v)
    if (surface.vertex_is_boundary[v] &&
        groups.root(static_cast<std::int32_t>(v)) == static_cast<std::int32_t>(v))
      ++count;
  return count;
}

std::int64_t count_duplicates(const TriangleMesh& mesh) {
  auto sorted = mesh.triangles;
  for (auto& corners : sorted) std::sort(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end());
  return std::distance(std::unique(sorted.begin(), sorted.end()), sorted.end());
}

void count_defects(const Surface& surface, ValidityReport& report) {
  for (std::int32_t e = 0; e < surface.adjacency.edge_count(); ++e)
    if (surface.edge_is_boundary[static_cast<std::size_t>(e)] && !surface.is_of_collapsed(e))
      ++report.boundary_edges;
  report.boundary_loops = count_boundary_loops(surface);
  for (std::int32_t e = 0; e < surface.adjacency.edge_count(); ++e) {
    if (!surface.edge_is_non_manifold[static_cast<std::size_t>(e)]) continue;
    ++(surface.adjacency.edge_triangles[e].size() > 2 ? report.non_manifold_edges : report.misoriented_edges);
  }
  for (std::int32_t v = 0; v < report.vertices; ++v)
    if (surface.adjacency.vertex_triangles[v].empty()) ++report.unused_vertices;
  report.non_manifold_vertices = count_true(surface.vertex_has_several_fans);
  report.duplicate_triangles = count_duplicates(surface.mesh);
  report.components = count_components(surface);
  report.closed = report.triangles > 0 && report.boundary_edges == 0;
  report.manifold = report.non_manifold_edges == 0 && report.non_manifold_vertices == 0;
  report.consistently_oriented = report.misoriented_edges == 0;
}

void measure(const Surface& surface, ValidityReport& report) {
  const Vec3 centre = bounding_box_centre(surface.mesh);
  double volume = 0.0;
  report.shortest_edge = report.triangles > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    const Triangle corners = surface.mesh.triangle(static_cast<std::int32_t>(t));
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double side = (corners[(k + 1) % 3] - corners[k]).stableNorm();
      longest = std::max(longest, side);
      report.shortest_edge = std::min(report.shortest_edge, side);
    }
    report.longest_edge = std::max(report.longest_edge, longest);
    if (surface.face_normals[t].isZero(0.0)) {
      ++report.degenerate_triangles;
      continue;
    }
    const double double_area =
        (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(surface.face_normals[t]);
    report.area += 0.5 * double_area;
    report.worst_aspect = std::max(report.worst_aspect, longest * longest / double_area);
    volume += (corners[0] - centre).dot((corners[1] - centre).cross(corners[2] - centre)) / 6.0;
  }
  if (report.closed && report.consistently_oriented) report.volume = volume;
  if (report.consistently_oriented) {
    TriangleMesh turned = surface.mesh;
    report.inward_triangles = orient_outward(turned, surface.adjacency).turned_triangles;
    if (report.inward_triangles > 0)
      report.outward = false;
    else if (report.closed && std::abs(volume) > ZERO_VOLUME * std::pow(report.area, 1.5))
      report.outward = true;
  }
  report.diagonal = bounding_box_diagonal(surface.mesh);
  report.mean_edge_length = mean_edge_length(surface.mesh);
}

}  // namespace

ValidityReport check_mesh(const Surface& surface) {
  ValidityReport report;
  report.vertices = static_cast<std::int64_t>(surface.mesh.vertices.size());
  report.edges = surface.adjacency.edge_count();
  report.triangles = static_cast<std::int64_t>(surface.mesh.triangles.size());
  count_defects(surface, report);
  measure(surface, report);
  if (report.closed && report.manifold && report.consistently_oriented) {
    // Euler and Poincare: V - E + T = 2 (components - genus), without collapsed triangles.
    std::int64_t edges = 0;
    for (std::int32_t e = 0; e < surface.adjacency.edge_count(); ++e)
      if (!surface.is_of_collapsed(e)) ++edges;
    const auto collapsed = static_cast<std::int64_t>(surface.adjacency.collapsed.size());
    const std::int64_t euler =
        report.vertices - report.unused_vertices - edges + report.triangles - collapsed;
    report.genus = report.components - euler / 2;
  }
  return report;
}

}  // namespace lmdbench
