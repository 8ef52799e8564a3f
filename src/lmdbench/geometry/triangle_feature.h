// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace lmdbench {

/// The feature of a triangle on which a closest point lies: local tracking picks the neighbourhood
/// from it (paper, Fig. 5). Edge k joins corner k and corner (k + 1) % 3.
enum class TriangleFeature : std::uint8_t { V0, V1, V2, E0, E1, E2, FACE };

constexpr bool is_vertex(TriangleFeature feature) {
  return feature <= TriangleFeature::V2;
}
constexpr bool is_edge(TriangleFeature feature) {
  return feature >= TriangleFeature::E0 && feature <= TriangleFeature::E2;
}
constexpr bool is_face(TriangleFeature feature) {
  return feature == TriangleFeature::FACE;
}

/// Corner number 0..2 of a vertex feature, or edge number 0..2 of an edge feature.
constexpr int local_index(TriangleFeature feature) {
  return static_cast<int>(feature) % 3;
}

constexpr TriangleFeature vertex_feature(int corner) {
  return static_cast<TriangleFeature>(corner);
}
constexpr TriangleFeature edge_feature(int edge) {
  return static_cast<TriangleFeature>(3 + edge);
}

}  // namespace lmdbench
