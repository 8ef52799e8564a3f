// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/csr_rows.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// The triangles of every edge. Nearly all edges have one or two, kept as pairs without the offsets
/// that rows of any length need; longer rows are kept apart.
class EdgeTriangles {
 public:
  EdgeTriangles() = default;
  explicit EdgeTriangles(std::size_t edge_count) : pairs_(edge_count, {NONE, NONE}) {}

  /// Adds a triangle to an edge, unless it was the last one added there.
  void add(std::int32_t edge, std::int32_t triangle) {
    const auto present = (*this)[edge];
    if (!present.empty() && present.back() == triangle) return;
    auto& pair = pairs_[static_cast<std::size_t>(edge)];
    if (present.size() < 2) {
      pair[present.size()] = triangle;
      return;
    }
    if (present.size() == 2) {
      rows_.emplace_back(present.begin(), present.end());
      pair[1] = FIRST_ROW - static_cast<std::int32_t>(rows_.size() - 1);
    }
    rows_[static_cast<std::size_t>(FIRST_ROW - pair[1])].push_back(triangle);
  }

  /// In the order in which they were added.
  std::span<const std::int32_t> operator[](std::int32_t edge) const {
    const auto& pair = pairs_[static_cast<std::size_t>(edge)];
    if (pair[1] > NONE) return pair;
    if (pair[1] == NONE) return {pair.data(), pair[0] == NONE ? 0u : 1u};
    return rows_[static_cast<std::size_t>(FIRST_ROW - pair[1])];
  }

  /// Memory that the lists take.
  std::size_t bytes() const {
    std::size_t sum = pairs_.size() * sizeof(pairs_[0]);
    for (const auto& row : rows_)
      sum += sizeof(std::vector<std::int32_t>) + row.capacity() * sizeof(std::int32_t);
    return sum;
  }

 private:
  static constexpr std::int32_t NONE = -1;       ///< No triangle.
  static constexpr std::int32_t FIRST_ROW = -2;  ///< As second entry: rows_[0]; -3: rows_[1], ...

  std::vector<std::array<std::int32_t, 2>> pairs_;
  std::vector<std::vector<std::int32_t>> rows_;
};

/// Whether a triangle has collapsed: it occupies no surface.
inline bool names_vertex_twice(const std::array<std::int32_t, 3>& corners) {
  return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

/// Neighbourhood of a mesh. Non-manifold edges keep all their triangles. Collapsed triangles are no
/// neighbours: they are in rows of edges and vertices that no other triangle has. (Rounding the
/// slivers of a Boolean operation to single precision leaves such triangles in many STL files; with
/// them closed meshes would have edges of three triangles.)
struct Adjacency {
  std::vector<std::array<std::int32_t, 2>> edges;  ///< #E by 2, vertex indices, smaller one first.
  std::vector<std::array<std::int32_t, 3>>
      triangle_edges;                   ///< #T by 3; side k joins corners k and (k + 1) % 3.
  EdgeTriangles edge_triangles;         ///< #E lists of triangles, ascending.
  CsrRows vertex_triangles;             ///< #V rows of triangles, ascending.
  std::vector<std::int32_t> collapsed;  ///< Triangles that name a vertex twice, ascending.

  std::int32_t edge_count() const { return static_cast<std::int32_t>(edges.size()); }
  /// Memory that all of this takes.
  std::size_t bytes() const;
};

/// Edges are numbered in the order of their first triangle side: numbers depend on the mesh alone.
/// A collapsed triangle has a side {v, v} and is once in each row that it is in.
/// @pre every index is within the vertex array (import checks it)
Adjacency build_adjacency(const TriangleMesh& mesh);

}  // namespace lmdbench
