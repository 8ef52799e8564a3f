// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/triangle_distance_steps.h>

#include <algorithm>
#include <cmath>

// A guess of the features proves nearly every pair of disjoint triangles in general position.
// Contact, parallel features and degenerate triangles are left to all candidates. Both give the
// same bits where both answer.

namespace lmdbench {
namespace {

/// Products of four coordinates must neither overflow nor lose digits to underflow. Outside this
/// range of the largest coordinate, triangles are scaled by a power of two, which is exact.
constexpr double SMALLEST_MAGNITUDE = 0x1p-100;
constexpr double LARGEST_MAGNITUDE = 0x1p+100;

/// @param exponent brings the largest coordinate to [1, 2)
Triangle scaled(const Triangle& triangle, int exponent) {
  Triangle result;
  for (int k = 0; k < 3; ++k) {
    result[k] = triangle[k].unaryExpr([exponent](double value) { return std::ldexp(value, exponent); });
  }
  return result;
}

/// Takes a point and its feature from the scaled triangle back to the caller's. A corner is copied,
/// because scaling back would round denormal coordinates; of corners that scaling made equal it is
/// the lowest, whatever their order.
void scale_back(const Triangle& triangle, const Triangle& scaled_triangle, int exponent, Vec3& point,
                TriangleFeature& feature) {
  if (!is_vertex(feature)) {
    point = point.unaryExpr([exponent](double value) { return std::ldexp(value, -exponent); });
    return;
  }
  const Vec3& scaled_corner = scaled_triangle[local_index(feature)];
  for (int k = 0; k < 3; ++k) {
    if (scaled_triangle[k] == scaled_corner &&
        lexicographic_less(triangle[k], triangle[local_index(feature)])) {
      feature = vertex_feature(k);
    }
  }
  point = triangle[local_index(feature)];
}

TrianglePairDistance distance_by_scaled_candidates(const Triangle& a, const Triangle& b, double magnitude) {
  const int exponent = -std::ilogb(magnitude);
  const Triangle scaled_a = scaled(a, exponent);
  const Triangle scaled_b = scaled(b, exponent);
  TrianglePairDistance result = kernel::distance_by_all_candidates(
      scaled_a, scaled_b, coincidence_length(std::ldexp(magnitude, exponent)));
  scale_back(a, scaled_a, exponent, result.point_a, result.feature_a);
  scale_back(b, scaled_b, exponent, result.point_b, result.feature_b);
  if (result.intersecting) {
    const bool use_b = is_vertex(result.feature_b) &&
                       (!is_vertex(result.feature_a) || lexicographic_less(result.point_b, result.point_a));
    (use_b ? result.point_a : result.point_b) = use_b ? result.point_b : result.point_a;
  }
  result.squared_distance = (result.point_a - result.point_b).squaredNorm();
  result.minimiser_measure = std::ldexp(result.minimiser_measure, -exponent * result.minimiser_dimension);
  return result;
}

}  // namespace

TrianglePairDistance triangle_distance(const Triangle& a, const Triangle& b) {
  const double magnitude = std::max(largest_coordinate(a), largest_coordinate(b));
  const bool in_range = magnitude >= SMALLEST_MAGNITUDE && magnitude <= LARGEST_MAGNITUDE;
  const double tolerance = coincidence_length(magnitude);
  TrianglePairDistance result;
  // Nothing is proved where a coordinate is not a number.
  if (in_range && kernel::prove_by_features(a, b, tolerance, result)) return result;
  if (!all_finite(a) || !all_finite(b)) return result;
  return in_range || magnitude == 0.0 ? kernel::distance_by_all_candidates(a, b, tolerance)
                                      : distance_by_scaled_candidates(a, b, magnitude);
}

}  // namespace lmdbench
