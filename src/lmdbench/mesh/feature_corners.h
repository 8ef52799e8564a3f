// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace lmdbench {

/// Vertices of a feature with its ends: one, two or three.
class FeatureCorners {
 public:
  FeatureCorners(const Surface& surface, const FeatureId& feature) {
    const auto index = static_cast<std::size_t>(feature.index);
    switch (feature.kind) {
      case FeatureKind::VERTEX:
        vertices_[count_++] = feature.index;
        break;
      case FeatureKind::EDGE:
        for (const std::int32_t vertex : surface.adjacency.edges[index]) vertices_[count_++] = vertex;
        break;
      case FeatureKind::FACE:
        for (const std::int32_t vertex : surface.mesh.triangles[index]) vertices_[count_++] = vertex;
        break;
    }
  }
  std::span<const std::int32_t> view() const { return {vertices_.data(), count_}; }

 private:
  std::array<std::int32_t, 3> vertices_{};
  std::size_t count_ = 0;
};

}  // namespace lmdbench
