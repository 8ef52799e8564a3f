// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/vertex_fan.h>

#include <algorithm>

namespace lmdbench {

int fan_count(const Surface& surface, std::int32_t vertex) {
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
  const auto edges = surface.adjacency.vertex_edges[vertex];
  const bool on_non_manifold_edge = std::any_of(edges.begin(), edges.end(), [&](std::int32_t edge) {
    return surface.edge_is_non_manifold[static_cast<std::size_t>(edge)];
  });
  return on_non_manifold_edge || fan_count(surface, vertex) > 1;
}

}  // namespace lmdbench
