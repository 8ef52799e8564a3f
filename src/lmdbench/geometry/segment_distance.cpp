// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/segment_kernel.h>
#include <lmdbench/geometry/tolerance.h>

#include <array>

namespace lmdbench {
namespace {

SegmentFeature turned(SegmentFeature feature) {
  switch (feature) {
    case SegmentFeature::V0:
      return SegmentFeature::V1;
    case SegmentFeature::V1:
      return SegmentFeature::V0;
    case SegmentFeature::EDGE:
      break;
  }
  return SegmentFeature::EDGE;
}

}  // namespace

PointSegmentDistance point_segment_distance(const Vec3& point, const Segment& segment) {
  const std::array<Vec3, 3> points{point, segment[0], segment[1]};
  const double tolerance = coincidence_length(largest_coordinate(points));
  const bool turn = lexicographic_less(segment[1], segment[0]);
  const auto nearest =
      kernel::project_on_segment(point, segment[turn ? 1 : 0], segment[turn ? 0 : 1], tolerance);
  return {nearest.squared_distance, nearest.point, turn ? turned(nearest.feature) : nearest.feature};
}

SegmentPairDistance segment_distance(const Segment& a, const Segment& b) {
  const std::array<Vec3, 4> points{a[0], a[1], b[0], b[1]};
  const double tolerance = coincidence_length(largest_coordinate(points));
  const bool turn_a = lexicographic_less(a[1], a[0]);
  const bool turn_b = lexicographic_less(b[1], b[0]);
  kernel::PointsOnSegments nearest;
  const bool a_first = kernel::segment_pair(a[turn_a ? 1 : 0], a[turn_a ? 0 : 1], b[turn_b ? 1 : 0],
                                            b[turn_b ? 0 : 1], tolerance, nearest);
  SegmentPairDistance result;
  result.squared_distance = nearest.squared_distance;
  result.point_a = a_first ? nearest.p : nearest.q;
  result.point_b = a_first ? nearest.q : nearest.p;
  result.feature_a = a_first ? nearest.feature_p : nearest.feature_q;
  result.feature_b = a_first ? nearest.feature_q : nearest.feature_p;
  if (turn_a) result.feature_a = turned(result.feature_a);
  if (turn_b) result.feature_b = turned(result.feature_b);
  result.minimiser_dimension = nearest.overlap_length > 0.0 ? 1 : 0;
  result.minimiser_measure = nearest.overlap_length;
  return result;
}

}  // namespace lmdbench
