// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/parallel.h>
#include <lmdbench/mesh/adjacency.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace lmdbench {
namespace {

/// Sides are numbered 3 * triangle + k; side k joins corners k and (k + 1) % 3.
using SideIndex = std::uint32_t;

/// Vertices that one task takes at a time.
constexpr std::size_t VERTICES_A_TASK = 4096;

/// Calls visit(vertex) for each vertex of a triangle, once where the triangle names it twice.
template <class Visit>
void for_each_vertex(const std::array<std::int32_t, 3>& corners, Visit visit) {
  visit(corners[0]);
  if (corners[1] != corners[0]) visit(corners[1]);
  if (corners[2] != corners[0] && corners[2] != corners[1]) visit(corners[2]);
}

/// @param is_listed whether a triangle is in the row of a vertex of its own
template <class IsListed>
CsrRows triangles_of_vertices(const TriangleMesh& mesh, IsListed is_listed) {
  std::vector<std::int32_t> offsets(mesh.vertices.size() + 1, 0);
  const auto for_each_listed = [&](std::size_t t, auto visit) {
    for_each_vertex(mesh.triangles[t], [&](std::int32_t vertex) {
      if (is_listed(t, vertex)) visit(vertex);
    });
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for_each_listed(t, [&](std::int32_t vertex) { ++offsets[static_cast<std::size_t>(vertex) + 1]; });
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<std::int32_t> items(static_cast<std::size_t>(offsets.back()));
  std::vector<std::int32_t> next(offsets.begin(), offsets.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for_each_listed(t, [&](std::int32_t vertex) {
      items[static_cast<std::size_t>(next[static_cast<std::size_t>(vertex)]++)] =
          static_cast<std::int32_t>(t);
    });
  }
  return {std::move(offsets), std::move(items)};
}

/// For every side the first side on the same edge. Each vertex sorts only the sides of which it is
/// the smaller end, so vertices are independent.
std::vector<SideIndex> first_sides(const TriangleMesh& mesh, const CsrRows& vertex_triangles) {
  std::vector<SideIndex> first(3 * mesh.triangles.size());
  parallel_ranges(mesh.vertices.size(), VERTICES_A_TASK, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint64_t> sides;  // larger vertex, then the side
    for (auto vertex = static_cast<std::int32_t>(begin); vertex < static_cast<std::int32_t>(end); ++vertex) {
      sides.clear();
      for (const std::int32_t triangle : vertex_triangles[vertex]) {
        const auto& corners = mesh.triangles[static_cast<std::size_t>(triangle)];
        for (std::size_t k = 0; k < 3; ++k) {
          const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % 3]);
          if (low != vertex) continue;
          const std::size_t side = 3 * static_cast<std::size_t>(triangle) + k;
          sides.push_back(static_cast<std::uint64_t>(high) << 32 | side);
        }
      }
      std::sort(sides.begin(), sides.end());
      for (std::size_t i = 0; i < sides.size(); ++i) {
        const auto side = static_cast<SideIndex>(sides[i]);
        const bool continues = i > 0 && sides[i] >> 32 == sides[i - 1] >> 32;
        first[side] = continues ? first[static_cast<SideIndex>(sides[i - 1])] : side;
      }
    }
  });
  return first;
}

}  // namespace

Adjacency build_adjacency(const TriangleMesh& mesh) {
  LMDBENCH_EXPECTS(std::ranges::all_of(mesh.triangles,
                                       [&](const auto& corners) {
                                         return std::ranges::all_of(corners, [&](std::int32_t v) {
                                           return v >= 0 &&
                                                  static_cast<std::size_t>(v) < mesh.vertices.size();
                                         });
                                       }),
                   "an index that import did not check");
  Adjacency adjacency;
  adjacency.vertex_triangles = triangles_of_vertices(mesh, [](std::size_t, std::int32_t) { return true; });
  const std::vector<SideIndex> first = first_sides(mesh, adjacency.vertex_triangles);
  std::size_t edge_count = 0;
  for (std::size_t side = 0; side < first.size(); ++side) edge_count += first[side] == side ? 1 : 0;

  adjacency.edges.reserve(edge_count);
  adjacency.triangle_edges.resize(mesh.triangles.size());
  adjacency.edge_triangles = EdgeTriangles(edge_count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool is_collapsed = names_vertex_twice(mesh.triangles[t]);
    if (is_collapsed) adjacency.collapsed.push_back(static_cast<std::int32_t>(t));
    for (std::size_t k = 0; k < 3; ++k) {
      const SideIndex earliest = first[3 * t + k];
      std::int32_t& edge = adjacency.triangle_edges[t][k];
      if (earliest == 3 * t + k) {
        edge = static_cast<std::int32_t>(adjacency.edges.size());
        const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
        adjacency.edges.push_back({low, high});
      } else {
        edge = adjacency.triangle_edges[earliest / 3][earliest % 3];
      }
      if (!is_collapsed) adjacency.edge_triangles.add(edge, static_cast<std::int32_t>(t));
    }
  }
  if (adjacency.collapsed.empty()) return adjacency;
  for (const std::int32_t t : adjacency.collapsed)
    for (const std::int32_t edge : adjacency.triangle_edges[static_cast<std::size_t>(t)]) {
      const auto row = adjacency.edge_triangles[edge];
      if (row.empty() || names_vertex_twice(mesh.triangles[static_cast<std::size_t>(row.front())]))
        adjacency.edge_triangles.add(edge, t);
    }
  std::vector<bool> has_whole(mesh.vertices.size());
  for (const auto& corners : mesh.triangles)
    if (!names_vertex_twice(corners))
      for (const std::int32_t vertex : corners) has_whole[static_cast<std::size_t>(vertex)] = true;
  adjacency.vertex_triangles = triangles_of_vertices(mesh, [&](std::size_t t, std::int32_t vertex) {
    return !names_vertex_twice(mesh.triangles[t]) || !has_whole[static_cast<std::size_t>(vertex)];
  });
  return adjacency;
}

std::size_t Adjacency::bytes() const {
  return edges.size() * sizeof(edges[0]) + triangle_edges.size() * sizeof(triangle_edges[0]) +
         edge_triangles.bytes() + vertex_triangles.bytes() + collapsed.size() * sizeof(collapsed[0]);
}

}  // namespace lmdbench
