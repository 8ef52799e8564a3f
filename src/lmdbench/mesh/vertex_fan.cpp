// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/mesh/vertex_fan.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace lmdbench {

namespace {

/// Walks round a vertex from triangle to triangle. False where that does not pass through all its triangles,
/// or the walk is not that simple: a boundary, corners that repeat, many triangles.
bool is_one_closed_fan(const Surface& surface, std::int32_t vertex) {
  constexpr std::size_t LARGEST = 16;
  const auto triangles = surface.adjacency.vertex_triangles[vertex];
  const std::size_t count = triangles.size();
  if (count == 0 || count > LARGEST) return false;
  std::array<std::int32_t, LARGEST> next{}, previous{};
  for (std::size_t i = 0; i < count; ++i) {
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(triangles[i])];
    const std::size_t k = corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
    next[i] = corners[(k + 1) % 3];
    previous[i] = corners[(k + 2) % 3];
  }
  const auto end = next.begin() + static_cast<std::ptrdiff_t>(count);
  std::int32_t corner = next[0];
  for (std::size_t steps = 1; steps <= count; ++steps) {
    const auto at = std::find(next.begin(), end, corner);
    if (at == end) return false;
    corner = previous[static_cast<std::size_t>(at - next.begin())];
    if (corner == next[0]) return steps == count;
  }
  return false;
}

}  // namespace

int fan_count(const Surface& surface, std::int32_t vertex) {
  LMDBENCH_EXPECTS(vertex >= 0 && static_cast<std::size_t>(vertex) < surface.mesh.vertices.size(),
                   "a vertex of another mesh");
  if (is_one_closed_fan(surface, vertex)) return 1;
  const auto triangles = surface.adjacency.vertex_triangles[vertex];
  std::vector<bool> reached(triangles.size(), false);
  const auto position = [&](std::int32_t triangle) {
    return static_cast<std::size_t>(std::lower_bound(triangles.begin(), triangles.end(), triangle) -
                                    triangles.begin());
  };
  int fans = 0;
  std::vector<std::int32_t> open;
  for (const std::int32_t first : triangles) {
    if (reached[position(first)]) continue;
    ++fans;
    reached[position(first)] = true;
    open.push_back(first);
    while (!open.empty()) {
      const std::int32_t triangle = open.back();
      open.pop_back();
      for (const std::int32_t edge : surface.adjacency.triangle_edges[static_cast<std::size_t>(triangle)]) {
        const auto& ends = surface.adjacency.edges[static_cast<std::size_t>(edge)];
        if (ends[0] != vertex && ends[1] != vertex) continue;
        for (const std::int32_t neighbour : surface.adjacency.edge_triangles[edge]) {
          const std::size_t at = position(neighbour);
          if (reached[at]) continue;
          reached[at] = true;
          open.push_back(neighbour);
        }
      }
    }
  }
  return fans;
}

bool is_non_manifold_vertex(const Surface& surface, std::int32_t vertex) {
  return surface.vertex_has_non_manifold_edge[static_cast<std::size_t>(vertex)] ||
         fan_count(surface, vertex) > 1;
}

}  // namespace lmdbench
