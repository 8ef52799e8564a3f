// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/all_candidates.h>
#include <lmdbench/geometry/certified_descent.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_distance.h>

#include <algorithm>
#include <cmath>

// A short descent proves nearly every pair of disjoint triangles in general position; contact, parallel
// features and degenerate triangles are left to the examination of all candidates. Both give the same bits
// where both answer.

namespace lmdbench {
namespace {

/// Products of four coordinates must neither overflow nor lose digits to underflow; outside this range of the
/// largest coordinate the triangles are scaled by a power of two, which is exact.
constexpr double SMALLEST_MAGNITUDE = 0x1p-100;
constexpr double LARGEST_MAGNITUDE = 0x1p+100;

/// Corner points are copied from the caller's triangle: scaling back would round denormal coordinates.
Vec3 unscaled(const Vec3& point, TriangleFeature feature, const Triangle& triangle, int exponent) {
  if (is_vertex(feature)) return triangle[local_index(feature)];
  return point.unaryExpr([exponent](double value) { return std::ldexp(value, -exponent); });
}

TrianglePairDistance distance_out_of_range(const Triangle& a, const Triangle& b, double magnitude) {
  const int exponent = -std::ilogb(magnitude);
  const auto scaled = [exponent](const Triangle& triangle) {
    Triangle result;
    for (int i = 0; i < 3; ++i) {
      result[i] = triangle[i].unaryExpr([exponent](double value) { return std::ldexp(value, exponent); });
    }
    return result;
  };
  TrianglePairDistance result = kernel::distance_by_all_candidates(
      scaled(a), scaled(b), coincidence_length(std::ldexp(magnitude, exponent)));
  result.point_a = unscaled(result.point_a, result.feature_a, a, exponent);
  result.point_b = unscaled(result.point_b, result.feature_b, b, exponent);
  if (result.intersecting) result.point_b = result.point_a;
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
  // The descent proves nothing where a coordinate is not a number.
  if (in_range && kernel::certified_descent(a, b, tolerance, result)) return result;
  if (!all_finite(a) || !all_finite(b)) return result;
  const bool all_zero = magnitude == 0.0;
  return in_range || all_zero ? kernel::distance_by_all_candidates(a, b, tolerance)
                              : distance_out_of_range(a, b, magnitude);
}

}  // namespace lmdbench
