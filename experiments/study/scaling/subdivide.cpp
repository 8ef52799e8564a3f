// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/adjacency.h>

#include <study/scaling/subdivide.h>

#include <utility>

namespace lmdbench::scaling {

TriangleMesh subdivided(TriangleMesh mesh, int levels) {
  for (int level = 0; level < levels; ++level) {
    const Adjacency adjacency = build_adjacency(mesh);
    const auto first_middle = static_cast<std::int32_t>(mesh.vertices.size());
    TriangleMesh finer;
    finer.vertices = mesh.vertices;
    for (const auto& [a, b] : adjacency.edges)
      finer.vertices.push_back(
          0.5 * (mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)]));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const auto& sides = adjacency.triangle_edges[t];
      const std::int32_t ab = first_middle + sides[0], bc = first_middle + sides[1],
                         ca = first_middle + sides[2];
      finer.triangles.insert(finer.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh = std::move(finer);
  }
  return mesh;
}

}  // namespace lmdbench::scaling
