// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>

namespace lmdbench {

/// Calls visit(neighbour) for the other ends of a vertex's edges, in the order of its triangles,
/// until visit returns false.
/// Where each edge at the vertex has two triangles that agree on orientation, one of them runs away
/// from the vertex: the corners after the vertex are all its neighbours, once each unless a
/// triangle names it twice. Elsewhere the corners before it are visited too; a neighbour may come
/// twice.
/// @return whether visit never returned false
template <class Visit>
bool for_each_neighbour(const Surface& surface, std::int32_t vertex, Visit visit) {
  const auto v = static_cast<std::size_t>(vertex);
  const bool next_is_enough = !surface.vertex_is_boundary[v] && !surface.vertex_has_non_manifold_edge[v];
  for (const std::int32_t triangle : surface.adjacency.vertex_triangles[vertex]) {
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(triangle)];
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[k] != vertex) continue;
      const std::int32_t next = corners[(k + 1) % 3], previous = corners[(k + 2) % 3];
      if (next != vertex && !visit(next)) return false;
      if (!next_is_enough && previous != vertex && !visit(previous)) return false;
    }
  }
  return true;
}

}  // namespace lmdbench
