// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_feature.h>

#include <array>

namespace lmdbench::kernel {

/// The corners whose hull carries the current point of one triangle: a corner, an edge or the face.
struct Carriers {
  std::array<int, 3> corner{};
  int count = 0;

  static constexpr Carriers one(int k) { return {{k, 0, 0}, 1}; }
  static constexpr Carriers two(int k, int l) { return {{k, l, 0}, 2}; }
  static constexpr Carriers all() { return {{0, 1, 2}, 3}; }

  void add(int k) { corner[count++] = k; }
  void keep_only(int k) {
    corner[0] = k;
    count = 1;
  }

  TriangleFeature feature() const {
    switch (count) {
      case 1:
        return vertex_feature(corner[0]);
      case 2:
        return edge_feature((4 - corner[0] - corner[1]) % 3);
      default:
        return TriangleFeature::FACE;
    }
  }
};

}  // namespace lmdbench::kernel
