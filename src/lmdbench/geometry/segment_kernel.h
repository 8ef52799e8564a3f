// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/tolerance.h>

#include <algorithm>
#include <cmath>

/// Inner functions of the distance queries, inline because the triangle kernel calls them 9 and more times a
/// pair. Every segment comes with its ends in lexicographic order, so that an edge seen from two neighbouring
/// triangles gives the same bits; `tolerance` is coincidence_length of the coordinates at hand.
namespace lmdbench::kernel {

/// Nearest point of the segment p0 p1 to x. Ends win within `tolerance`, and are then copied.
inline PointSegmentDistance project_on_segment(const Vec3& x, const Vec3& p0, const Vec3& p1,
                                               double tolerance) {
  const Vec3 d = p1 - p0;
  const double squared_length = d.squaredNorm();
  // Distances along the segment from both ends, times its length: each is accurate near its own end.
  const double from_p0 = (x - p0).dot(d);
  const double from_p1 = (p1 - x).dot(d);
  const double squared_limit = tolerance * tolerance * squared_length;
  const bool at_p0 = from_p0 <= 0.0 || from_p0 * from_p0 <= squared_limit;
  const bool at_p1 = from_p1 <= 0.0 || from_p1 * from_p1 <= squared_limit;
  PointSegmentDistance result;
  if (at_p0 || at_p1) {
    const double to_p0 = (x - p0).squaredNorm();
    const double to_p1 = (x - p1).squaredNorm();
    const bool first = at_p0 && (!at_p1 || to_p0 <= to_p1);
    result.point = first ? p0 : p1;
    result.squared_distance = first ? to_p0 : to_p1;
    result.feature = first ? SegmentFeature::V0 : SegmentFeature::V1;
    return result;
  }
  if (from_p0 <= from_p1) {
    result.point = p0 + (from_p0 / squared_length) * d;
  } else {
    result.point = p1 - (from_p1 / squared_length) * d;
  }
  result.squared_distance = (x - result.point).squaredNorm();
  return result;
}

/// Closest pair with an end q of one segment (`end_feature`) or, where q is nearest to an end of p, of that
/// end.
inline SegmentPairDistance pair_from_end(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1,
                                         SegmentFeature end_of_q, double tolerance) {
  SegmentPairDistance result;
  const Vec3& q = end_of_q == SegmentFeature::V0 ? q0 : q1;
  const PointSegmentDistance on_p = project_on_segment(q, p0, p1, tolerance);
  result.point_a = on_p.point;
  result.feature_a = on_p.feature;
  if (on_p.feature == SegmentFeature::EDGE) {
    result.point_b = q;
    result.feature_b = end_of_q;
    result.squared_distance = on_p.squared_distance;
  } else {
    const PointSegmentDistance on_q = project_on_segment(on_p.point, q0, q1, tolerance);
    result.point_b = on_q.point;
    result.feature_b = on_q.feature;
    result.squared_distance = on_q.squared_distance;
  }
  return result;
}

inline SegmentPairDistance swapped(const SegmentPairDistance& pair) {
  SegmentPairDistance result = pair;
  std::swap(result.point_a, result.point_b);
  std::swap(result.feature_a, result.feature_b);
  return result;
}

/// Segments that drift apart by less than `tolerance` over the length of q; p is the longer one.
inline SegmentPairDistance parallel_segments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1,
                                             double squared_length, double tolerance) {
  const Vec3 d = p1 - p0;
  const double along_q0 = (q0 - p0).dot(d) / squared_length;
  const double along_q1 = (q1 - p0).dot(d) / squared_length;
  const double begin = std::max(0.0, std::min(along_q0, along_q1));
  const double end = std::min(1.0, std::max(along_q0, along_q1));
  const double overlap = (end - begin) * std::sqrt(squared_length);
  if (overlap > tolerance) {
    const double middle = 0.5 * (begin + end);
    const double t = std::clamp((middle - along_q0) / (along_q1 - along_q0), 0.0, 1.0);
    SegmentPairDistance result;
    result.point_a = p0 + middle * d;
    result.point_b = q0 + t * (q1 - q0);
    result.squared_distance = (result.point_a - result.point_b).squaredNorm();
    result.minimiser_dimension = 1;
    result.minimiser_measure = overlap;
    return result;
  }
  // They overlap in a point at most, or q is shorter than the tolerance: some end is a minimiser.
  SegmentPairDistance best = pair_from_end(p0, p1, q0, q1, SegmentFeature::V0, tolerance);
  const SegmentPairDistance other = pair_from_end(p0, p1, q0, q1, SegmentFeature::V1, tolerance);
  if (other.squared_distance < best.squared_distance) best = other;
  return best;
}

/// Closest points of the segments p0 p1 and q0 q1, p being the longer one.
///
/// - Split d2 = q1 - q0 and r = q0 - p0 into parts along and across d1 = p1 - p0. Across, the pair of lines
/// is one
///   point and one line: t = -(r' . d2') / (d2' . d2') is the nearest point of q's line to p's line. The
///   textbook denominator |d1|^2 |d2|^2 - (d1 . d2)^2 is the same number but loses the angle below 1e-8; this
///   form places the points with an error of a few roundings of the segments' length for every angle.
/// - Clamp t, project on p, clamp, project back (C. Ericson, "Real-Time Collision Detection", 2005,
/// section 5.1.9):
///   each step is a feasible pair and the last is the minimum of a convex function over the box.
inline SegmentPairDistance ordered_segment_distance(const Vec3& p0, const Vec3& p1, const Vec3& q0,
                                                    const Vec3& q1, double squared_length_p,
                                                    double squared_length_q, double tolerance) {
  const Vec3 d1 = p1 - p0;
  const Vec3 d2 = q1 - q0;
  const Vec3 r = q0 - p0;
  const double mu = d1.dot(d2) / squared_length_p;
  const Vec3 d2_across = d2 - mu * d1;
  const double squared_across = d2_across.squaredNorm();
  // Also true when p, and with it q, is a point; the negated form would let 0 / 0 through.
  if (!(squared_across > tolerance * tolerance)) {
    if (!(squared_length_p > 0.0)) {
      SegmentPairDistance points;
      points.point_a = p0;
      points.point_b = q0;
      points.feature_a = points.feature_b = SegmentFeature::V0;
      points.squared_distance = r.squaredNorm();
      return points;
    }
    return parallel_segments(p0, p1, q0, q1, squared_length_p, tolerance);
  }
  const double sigma = d1.dot(r) / squared_length_p;
  const Vec3 r_across = r - sigma * d1;
  const double t = -r_across.dot(d2_across) / squared_across;
  const double squared_tolerance = tolerance * tolerance;
  if (t <= 0.0 || t * t * squared_length_q <= squared_tolerance) {
    return pair_from_end(p0, p1, q0, q1, SegmentFeature::V0, tolerance);
  }
  if (t >= 1.0 || (1.0 - t) * (1.0 - t) * squared_length_q <= squared_tolerance) {
    return pair_from_end(p0, p1, q0, q1, SegmentFeature::V1, tolerance);
  }
  const double s = sigma + t * mu;
  if (s <= 0.0 || s * s * squared_length_p <= squared_tolerance) {
    return swapped(pair_from_end(q0, q1, p0, p1, SegmentFeature::V0, tolerance));
  }
  if (s >= 1.0 || (1.0 - s) * (1.0 - s) * squared_length_p <= squared_tolerance) {
    return swapped(pair_from_end(q0, q1, p0, p1, SegmentFeature::V1, tolerance));
  }
  SegmentPairDistance result;
  result.point_a = p0 + s * d1;
  result.point_b = q0 + t * d2;
  result.squared_distance = (result.point_a - result.point_b).squaredNorm();
  return result;
}

/// As above for segments in any order of length; the order of the arguments does not matter.
inline SegmentPairDistance segment_pair(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1,
                                        double tolerance) {
  const double squared_length_p = (p1 - p0).squaredNorm();
  const double squared_length_q = (q1 - q0).squaredNorm();
  const bool p_first = squared_length_p != squared_length_q ? squared_length_p > squared_length_q
                       : p0 != q0                           ? lexicographic_less(p0, q0)
                                                            : lexicographic_less(p1, q1);
  if (p_first) return ordered_segment_distance(p0, p1, q0, q1, squared_length_p, squared_length_q, tolerance);
  return swapped(ordered_segment_distance(q0, q1, p0, p1, squared_length_q, squared_length_p, tolerance));
}

}  // namespace lmdbench::kernel
