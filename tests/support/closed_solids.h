// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/shapes.h>

#include <array>
#include <map>
#include <set>

/// Closed meshes that bound solids of known Euler characteristics.
namespace lmdbench::testing {

using Voxel = std::array<int, 3>;

/// Unit cubes joined at faces, given by one corner each; no two may share only an edge or a corner.
inline TriangleMesh make_voxels(const std::set<Voxel>& cubes) {
  TriangleMesh mesh;
  std::map<Voxel, std::int32_t> vertices;
  const auto vertex = [&](const Voxel& at) {
    const auto [found, is_new] = vertices.try_emplace(at, static_cast<std::int32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.emplace_back(at[0], at[1], at[2]);
    return found->second;
  };
  for (const Voxel& cube : cubes)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        Voxel beside = cube;
        beside[axis] += side == 1 ? 1 : -1;
        if (cubes.contains(beside)) continue;
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        Voxel low = cube;
        low[axis] += side;
        Voxel right = low, far = low, up = low;
        ++right[u], ++far[u], ++far[v], ++up[v];
        const std::int32_t a = vertex(low), b = vertex(right), c = vertex(far), d = vertex(up);
        if (side == 1) {
          mesh.triangles.push_back({a, b, c});
          mesh.triangles.push_back({a, c, d});
        } else {
          mesh.triangles.push_back({a, c, b});
          mesh.triangles.push_back({a, d, c});
        }
      }
  return mesh;
}

/// A plate with a row of square holes.
inline TriangleMesh make_plate_with_holes(int holes) {
  std::set<Voxel> cubes;
  for (int x = 0; x < 2 * holes + 1; ++x)
    for (int y = 0; y < 3; ++y)
      if (x % 2 == 0 || y != 1) cubes.insert({x, y, 0});
  return make_voxels(cubes);
}

}  // namespace lmdbench::testing
