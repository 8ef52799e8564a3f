// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_feature.h>

#include <compare>
#include <cstdint>
#include <string_view>

namespace lmdbench {

enum class FeatureKind : std::uint8_t { VERTEX, EDGE, FACE };

/// Stable name of a vertex, edge or face of a mesh, whichever triangle was visited.
/// `index` counts TriangleMesh::vertices, Adjacency::edges or TriangleMesh::triangles.
struct FeatureId {
  FeatureKind kind = FeatureKind::FACE;
  std::int32_t index = -1;

  auto operator<=>(const FeatureId&) const = default;
};

/// "vertex", "edge" or "face": the spelling of the query contract.
constexpr std::string_view to_string(FeatureKind kind) {
  switch (kind) {
    case FeatureKind::VERTEX:
      return "vertex";
    case FeatureKind::EDGE:
      return "edge";
    case FeatureKind::FACE:
      return "face";
  }
  return "unknown";
}

}  // namespace lmdbench
