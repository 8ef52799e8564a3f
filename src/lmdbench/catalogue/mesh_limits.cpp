// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/mesh_limits.h>

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench {
namespace {

/// Triangles of every vertex, in a row; one that names a vertex twice is there twice.
struct VertexTriangles {
  std::vector<std::size_t> begin;  ///< Of vertex v in `triangles`; one entry more than vertices.
  std::vector<std::int32_t> triangles;

  explicit VertexTriangles(const TriangleMesh& mesh)
      : begin(mesh.vertices.size() + 1, 0), triangles(3 * mesh.triangles.size()) {
    for (const auto& corners : mesh.triangles)
      for (const std::int32_t corner : corners) ++begin[static_cast<std::size_t>(corner) + 1];
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::int32_t corner : mesh.triangles[t])
        triangles[next[static_cast<std::size_t>(corner)]++] = static_cast<std::int32_t>(t);
  }
};

[[noreturn]] void refuse(const std::string& file, std::int32_t triangle, const std::string& what,
                         Limit limit) {
  throw InputError(
      file, fmt::format("triangle {}", triangle),
      fmt::format("{}, above the limit of {}", what, limit_of(limit)),
      "repair the mesh (copies of triangles? a fan that should be a grid?), or " + raise_remedy(limit));
}

}  // namespace

void check_mesh_limits(const TriangleMesh& mesh, const std::string& file) {
  const auto triangle_count = static_cast<std::int64_t>(mesh.triangles.size());
  if (triangle_count > limit_of(Limit::TRIANGLES))
    throw InputError(
        file, "",
        fmt::format("has {} triangles, above the limit of {}", triangle_count, limit_of(Limit::TRIANGLES)),
        "decimate the mesh, or " + raise_remedy(Limit::TRIANGLES));
  const VertexTriangles at(mesh);
  // For each vertex, how often its triangles have each other vertex: the triangles of their edge.
  struct Meeting {
    std::int32_t with = -1;
    std::int64_t count = 0;
  };
  std::vector<Meeting> met(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto vertex = static_cast<std::int32_t>(v);
    const auto around = static_cast<std::int64_t>(at.begin[v + 1] - at.begin[v]);
    if (around > limit_of(Limit::VERTEX_TRIANGLES))
      refuse(file, at.triangles[at.begin[v]], fmt::format("vertex {} is in {} triangles", v, around),
             Limit::VERTEX_TRIANGLES);
    for (std::size_t i = at.begin[v]; i < at.begin[v + 1]; ++i) {
      const std::int32_t triangle = at.triangles[i];
      for (const std::int32_t other : mesh.triangles[static_cast<std::size_t>(triangle)]) {
        if (other <= vertex) continue;
        Meeting& meeting = met[static_cast<std::size_t>(other)];
        meeting = meeting.with == vertex ? Meeting{vertex, meeting.count + 1} : Meeting{vertex, 1};
        if (meeting.count > limit_of(Limit::EDGE_TRIANGLES))
          refuse(file, triangle,
                 fmt::format("the edge of vertices {} and {} is in {} triangles or more", vertex, other,
                             meeting.count),
                 Limit::EDGE_TRIANGLES);
      }
    }
  }
}

}  // namespace lmdbench
