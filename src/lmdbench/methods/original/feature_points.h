// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_feature.h>
#include <lmdbench/geometry/types.h>

#include <array>
#include <cstddef>

namespace lmdbench {

/// The original algorithm's stand-in for a triangle (test G4; paper, section 3.2.1): with N = 7 its
/// 3 corners, 3 edge midpoints and face centre. In an equilateral triangle every point is within
/// edge / (2 sqrt 3) of one: distances are over-estimated by at most that much a side. Other
/// numbers, for comparison: N = 3, the corners; 13, three even points an edge; 25, five an edge,
/// and round the centre corners and midpoints of the triangle at half size. Order: TriangleFeature,
/// then further points of edges, then of the face.
template <std::size_t N>
using FeaturePoints = std::array<Vec3, N>;

/// Further points an edge, beside its midpoint.
constexpr std::size_t more_edge_points(std::size_t points) {
  return points == 13 ? 2 : points == 25 ? 4 : 0;
}

/// Which part of the triangle feature point `index` of N stands for.
template <std::size_t N>
constexpr TriangleFeature part_of_feature_point(std::size_t index) {
  constexpr std::size_t PARTS = 7, MORE = more_edge_points(N);
  if (index < PARTS) return static_cast<TriangleFeature>(index);
  if constexpr (MORE > 0) {
    if (index < PARTS + 3 * MORE) return static_cast<TriangleFeature>(3 + (index - PARTS) / MORE);
  }
  return TriangleFeature::FACE;
}

/// Points of an edge are symmetric in its corners: its two triangles give the same bits.
template <std::size_t N>
FeaturePoints<N> feature_points(const Triangle& t) {
  static_assert(N == 3 || N == 7 || N == 13 || N == 25);
  FeaturePoints<N> points{t[0], t[1], t[2]};
  if constexpr (N >= 7) {
    points[3] = 0.5 * (t[0] + t[1]);
    points[4] = 0.5 * (t[1] + t[2]);
    points[5] = 0.5 * (t[2] + t[0]);
    points[6] = (t[0] + t[1] + t[2]) / 3.0;
  }
  constexpr std::size_t MORE = more_edge_points(N);
  std::size_t next = 7;
  if constexpr (MORE > 0) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const Vec3 &a = t[edge], &b = t[(edge + 1) % 3];
      for (std::size_t k = 1; k <= MORE / 2; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(MORE + 2);
        points[next++] = (1.0 - share) * a + share * b;
        points[next++] = (1.0 - share) * b + share * a;
      }
    }
  }
  if constexpr (N == 25)
    for (std::size_t part = 0; part < 6; ++part) points[next++] = 0.5 * (points[part] + points[6]);
  return points;
}

/// The nearest of all pairs; the first one in index order on ties.
struct FeaturePointPair {
  double squared_distance;
  std::size_t index_a;
  std::size_t index_b;
};

template <std::size_t N>
FeaturePointPair nearest_feature_points(const FeaturePoints<N>& a, const FeaturePoints<N>& b) {
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
