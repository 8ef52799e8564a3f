// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/csr_rows.h>
#include <lmdbench/mesh/edge_triangles.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <array>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// Who touches whom in a mesh. Non-manifold edges keep all their triangles.
struct Adjacency {
  std::vector<std::array<std::int32_t, 2>> edges;  ///< #E by 2, vertex indices, the smaller one first.
  std::vector<std::array<std::int32_t, 3>>
      triangle_edges;            ///< #T by 3; side k joins corners k and (k + 1) % 3.
  EdgeTriangles edge_triangles;  ///< #E lists of triangles, ascending.
  CsrRows vertex_triangles;      ///< #V rows of triangles, ascending.

  std::int32_t edge_count() const { return static_cast<std::int32_t>(edges.size()); }
  /// Memory that all of this takes.
  std::size_t bytes() const;
};

/// Edges are numbered in the order of their first triangle side, so the numbering depends on the mesh alone.
/// A triangle that names a vertex twice has a side {v, v} and stands once in each row that it belongs to.
/// @pre every index is within the vertex array (import checks it)
Adjacency build_adjacency(const TriangleMesh& mesh);

}  // namespace lmdbench
