// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench::testing {

/// Open sheet in the plane z = 0, two triangles for each '#' of the picture. Rows are from the top
/// down, squares have side `size` [m], and the picture's middle is at the origin.
/// @param is_upward  outer side
inline TriangleMesh sheet_of(const std::vector<std::string>& picture, double size, bool is_upward = true) {
  TriangleMesh mesh;
  std::map<std::pair<int, int>, std::int32_t> index_of;
  const auto rows = static_cast<int>(picture.size()), columns = static_cast<int>(picture.front().size());
  const auto corner = [&](int x, int y) {
    const auto [at, is_new] =
        index_of.emplace(std::pair(x, y), static_cast<std::int32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.emplace_back(size * (x - 0.5 * columns), size * (0.5 * rows - y), 0.0);
    return at->second;
  };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      if (picture[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] != '#') continue;
      std::int32_t a = corner(x, y + 1), b = corner(x + 1, y + 1), c = corner(x + 1, y), d = corner(x, y);
      if (!is_upward) std::swap(b, d);
      if ((x + y) % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  return mesh;
}

}  // namespace lmdbench::testing
