// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/adjacency.h>

#include <algorithm>
#include <utility>

namespace lmdbench {

namespace {

struct Side {
  std::array<std::int32_t, 2> vertices;  // the smaller one first
  std::size_t position;                  // 3 * triangle + k
};

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

// A triangle that names a vertex twice touches it once: rows hold each item once.
void add_once(Pairs& pairs, std::int32_t row, std::int32_t item, std::size_t items_of_triangle) {
  const auto end = pairs.end();
  if (std::find(end - static_cast<std::ptrdiff_t>(items_of_triangle), end, std::pair(row, item)) == end)
    pairs.emplace_back(row, item);
}

}  // namespace

Adjacency build_adjacency(const TriangleMesh& mesh) {
  const std::size_t triangle_count = mesh.triangles.size();
  std::vector<Side> sides;
  sides.reserve(3 * triangle_count);
  for (std::size_t t = 0; t < triangle_count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]});
      sides.push_back({{low, high}, 3 * t + k});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::pair(a.vertices, a.position) < std::pair(b.vertices, b.position);
  });

  // Sorting groups the sides of an edge, its first side leading; numbers then follow the first sides.
  std::vector<std::size_t> first_side(3 * triangle_count);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool continues = i > 0 && sides[i].vertices == sides[i - 1].vertices;
    first_side[sides[i].position] = continues ? first_side[sides[i - 1].position] : sides[i].position;
  }

  Adjacency adjacency;
  adjacency.triangle_edges.resize(triangle_count);
  std::vector<std::int32_t> number_of_first_side(3 * triangle_count, -1);
  Pairs edge_triangles, vertex_triangles, vertex_edges;
  for (std::size_t t = 0; t < triangle_count; ++t) {
    const auto triangle = static_cast<std::int32_t>(t);
    const std::size_t edges_before = edge_triangles.size(), vertices_before = vertex_triangles.size();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t tail = mesh.triangles[t][k], head = mesh.triangles[t][(k + 1) % 3];
      std::int32_t& number = number_of_first_side[first_side[3 * t + k]];
      if (number < 0) {
        number = static_cast<std::int32_t>(adjacency.edges.size());
        adjacency.edges.push_back({std::min(tail, head), std::max(tail, head)});
        vertex_edges.emplace_back(tail, number);
        if (head != tail) vertex_edges.emplace_back(head, number);
      }
      adjacency.triangle_edges[t][k] = number;
      add_once(edge_triangles, number, triangle, edge_triangles.size() - edges_before);
      add_once(vertex_triangles, tail, triangle, vertex_triangles.size() - vertices_before);
    }
  }
  const auto vertex_count = static_cast<std::int32_t>(mesh.vertices.size());
  adjacency.edge_triangles = IndexRows(adjacency.edge_count(), edge_triangles);
  adjacency.vertex_triangles = IndexRows(vertex_count, vertex_triangles);
  adjacency.vertex_edges = IndexRows(vertex_count, vertex_edges);
  return adjacency;
}

}  // namespace lmdbench
