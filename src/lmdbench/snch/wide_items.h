// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/snch/polar_cap.h>
#include <lmdbench/snch/wide_hierarchy.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// A feature while a wide hierarchy is built.
struct WideItem {
  PolarCap cap;
  WideRef ref;
  bool carries_lmd = false;  ///< False for triangles without area: they have no cap.
};

/// Corners of a feature, at most three.
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

/// The features that a hierarchy owns: vertices, edges and faces, each by index.
std::vector<WideItem> collect_wide_items(const Surface& surface, const WideBuildOptions& options);

}  // namespace lmdbench
