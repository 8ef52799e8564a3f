// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_feature.h>
#include <lmdbench/geometry/types.h>

#include <array>
#include <utility>

namespace lmdbench::kernel {

/// Ends of edge k among sorted corners: the lower one first, so an edge has one direction for all its
/// triangles.
inline constexpr std::array<std::array<int, 2>, 3> EDGE_ENDS{{{0, 1}, {1, 2}, {0, 2}}};

/// Corners in lexicographic order with the way back to the caller's numbering: the kernels work on these, so
/// that a permutation of the corners cannot change a bit of the result.
struct SortedTriangle {
  Triangle corners;
  std::array<int, 3> original{0, 1, 2};

  explicit SortedTriangle(const Triangle& triangle) : corners(triangle) {
    order(0, 1);
    order(1, 2);
    order(0, 1);
  }

  TriangleFeature vertex(int corner) const { return vertex_feature(original[corner]); }

  TriangleFeature edge(int k) const {
    // Edge j of a triangle joins corners j and j + 1, so the corner it does not touch is j + 2.
    const int opposite = 3 - EDGE_ENDS[k][0] - EDGE_ENDS[k][1];
    return edge_feature((original[opposite] + 1) % 3);
  }

  TriangleFeature edge_part(int k, SegmentFeature part) const {
    switch (part) {
      case SegmentFeature::V0:
        return vertex(EDGE_ENDS[k][0]);
      case SegmentFeature::V1:
        return vertex(EDGE_ENDS[k][1]);
      case SegmentFeature::EDGE:
        break;
    }
    return edge(k);
  }

  /// The caller's name of a feature of `corners`.
  TriangleFeature original_feature(TriangleFeature feature) const {
    if (is_vertex(feature)) return vertex(local_index(feature));
    if (is_edge(feature)) return edge_feature((original[(local_index(feature) + 2) % 3] + 1) % 3);
    return feature;
  }

 private:
  void order(int i, int j) {
    if (!lexicographic_less(corners[j], corners[i])) return;
    std::swap(corners[i], corners[j]);
    std::swap(original[i], original[j]);
  }
};

}  // namespace lmdbench::kernel
