// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_feature.h>
#include <lmdbench/geometry/types.h>

#include <array>
#include <cstddef>

namespace lmdbench {

/// The original algorithm's stand-in for a triangle (test G4; paper, section 3.2.1): its 3 corners, 3 edge
/// midpoints and face centre. Every point of the triangle is within edge / (2 sqrt 3) of one of them when it
/// is equilateral, so the distance is over-estimated by at most that much a side.
using FeaturePoints = std::array<Vec3, 7>;

/// Which part of the triangle feature point `index` stands for.
constexpr TriangleFeature part_of_feature_point(std::size_t index) {
  return static_cast<TriangleFeature>(index);
}

/// Points in the order of TriangleFeature. Midpoints are symmetric in their corners, so that both triangles
/// of an edge give the same bits.
inline FeaturePoints feature_points(const Triangle& t) {
  return {t[0],
          t[1],
          t[2],
          0.5 * (t[0] + t[1]),
          0.5 * (t[1] + t[2]),
          0.5 * (t[2] + t[0]),
          (t[0] + t[1] + t[2]) / 3.0};
}

/// The nearest of the 49 pairs; the first one in index order on ties.
struct FeaturePointPair {
  double squared_distance;
  std::size_t index_a;
  std::size_t index_b;
};

inline FeaturePointPair nearest_feature_points(const FeaturePoints& a, const FeaturePoints& b) {
  FeaturePointPair nearest{(a[0] - b[0]).squaredNorm(), 0, 0};
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double squared_distance = (a[i] - b[j]).squaredNorm();
      if (squared_distance < nearest.squared_distance) nearest = {squared_distance, i, j};
    }
  }
  return nearest;
}

}  // namespace lmdbench
