// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_feature.h>
#include <lmdbench/geometry/types.h>

#include <array>

namespace lmdbench::kernel {

/// Ends of edge k among sorted corners, lower one first: an edge has one direction in all its
/// triangles.
inline constexpr std::array<std::array<int, 2>, 3> EDGE_ENDS{{{0, 1}, {1, 2}, {0, 2}}};

/// Corners in lexicographic order with the way back to the caller's numbering. The kernels work on
/// these, so that a permutation of the corners cannot change a bit of the result.
struct SortedTriangle {
  Triangle corners;
  std::array<int, 3> original;

  explicit SortedTriangle(const Triangle& triangle) {
    // The rank of a corner is the number of corners below it, equal ones by index; no branches.
    const int below_10 = lexicographic_less(triangle[1], triangle[0]);
    const int below_20 = lexicographic_less(triangle[2], triangle[0]);
    const int below_21 = lexicographic_less(triangle[2], triangle[1]);
    original[below_10 + below_20] = 0;
    original[1 - below_10 + below_21] = 1;
    original[2 - below_20 - below_21] = 2;
    for (int k = 0; k < 3; ++k) corners[k] = triangle[original[k]];
  }

  TriangleFeature vertex(int corner) const { return vertex_feature(original[corner]); }

  TriangleFeature edge(int k) const {
    // Edge j joins corners j and j + 1, so the corner opposite to it is j + 2.
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
};

}  // namespace lmdbench::kernel
