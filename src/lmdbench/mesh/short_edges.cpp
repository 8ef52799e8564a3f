// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/adjacency.h>
#include <lmdbench/mesh/short_edges.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace lmdbench {

std::int64_t collapse_short_edges(TriangleMesh& mesh, double length) {
  const auto position = [&](std::int32_t v) -> const Vec3& {
    return mesh.vertices[static_cast<std::size_t>(v)];
  };
  std::vector<std::array<std::int32_t, 2>> short_edges;
  for (const auto& corners : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (const std::int32_t v = corners[k], w = corners[(k + 1) % 3];
          v != w && (position(w) - position(v)).norm() <= length)
        short_edges.push_back({v, w});
  if (short_edges.empty()) return 0;
  boost::disjoint_sets_with_storage<> places(mesh.vertices.size());
  for (const auto& [v, w] : short_edges)
    places.union_set(static_cast<std::size_t>(v), static_cast<std::size_t>(w));
  std::vector<std::int32_t> first(mesh.vertices.size());  // of each place, at its root
  std::iota(first.begin(), first.end(), 0);
  const auto key = [&](std::int32_t v) {
    return std::array{position(v).x(), position(v).y(), position(v).z()};
  };
  for (const auto& edge : short_edges)
    for (const std::int32_t v : edge) {
      std::int32_t& of_place = first[places.find_set(static_cast<std::size_t>(v))];
      if (key(v) < key(of_place)) of_place = v;
    }
  std::int64_t collapsed = 0;
  for (auto& corners : mesh.triangles) {
    const bool was = names_vertex_twice(corners);
    for (std::int32_t& v : corners) v = first[places.find_set(static_cast<std::size_t>(v))];
    collapsed += names_vertex_twice(corners) && !was ? 1 : 0;
  }
  return collapsed;
}

}  // namespace lmdbench
