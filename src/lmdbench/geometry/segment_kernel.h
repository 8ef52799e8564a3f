// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/tolerance.h>

#include <algorithm>
#include <cmath>

/// Inner functions of the distances, inline because the triangle kernel calls them up to nine times
/// a pair. Every segment comes with its ends in lexicographic order, so that an edge gives the same
/// bits from both its triangles; `tolerance` is coincidence_length of the coordinates. The result
/// types leave their members unset on purpose: every path sets all of them, and filling them first
/// costs a tenth of the time.
namespace lmdbench::kernel {

struct PointOnSegment {
  Vec3 point;
  double squared_distance;
  double squared_rise;  ///< see PointsOnSegments; 0 at an end
  SegmentFeature feature;
};

/// Closest points p and q of two segments.
struct PointsOnSegments {
  Vec3 p, q;
  double squared_distance;
  /// Lower bound of the growth of the squared distance from here to any end of a segment whose
  /// inside holds the point; else 0. Where it is lost in rounding, other pairs are as near.
  double squared_rise;
  double overlap_length;  ///< 0 where the minimiser is a single pair
  SegmentFeature feature_p, feature_q;
};

/// Nearest point of the segment p0 p1 to x. Ends win within `tolerance`, and are then copied.
inline PointOnSegment project_on_segment(const Vec3& x, const Vec3& p0, const Vec3& p1, double tolerance) {
  PointOnSegment result;
  const Vec3 d = p1 - p0;
  const double squared_length = d.squaredNorm();
  // Distances along the segment from both ends, times its length; each is accurate near its end.
  const double from_p0 = (x - p0).dot(d);
  const double from_p1 = (p1 - x).dot(d);
  const double squared_limit = tolerance * tolerance * squared_length;
  const bool at_p0 = from_p0 <= 0.0 || from_p0 * from_p0 <= squared_limit;
  const bool at_p1 = from_p1 <= 0.0 || from_p1 * from_p1 <= squared_limit;
  if (at_p0 || at_p1) {
    const double to_p0 = (x - p0).squaredNorm();
    const double to_p1 = (x - p1).squaredNorm();
    const bool first = at_p0 && (!at_p1 || to_p0 <= to_p1);
    result.point = first ? p0 : p1;
    result.squared_distance = first ? to_p0 : to_p1;
    result.feature = first ? SegmentFeature::V0 : SegmentFeature::V1;
    result.squared_rise = 0.0;
    return result;
  }
  // From the nearer end, where the division is more accurate.
  const bool first = from_p0 <= from_p1;
  const double part = (first ? from_p0 : -from_p1) / squared_length;
  result.point = (first ? p0 : p1) + part * d;
  result.squared_distance = (x - result.point).squaredNorm();
  result.feature = SegmentFeature::EDGE;
  result.squared_rise = part * part * squared_length;
  return result;
}

/// Closest pair that has the end `end_of_q` of q, or of the ends of p the one nearest to it.
inline void pair_from_end_of_q(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1,
                               SegmentFeature end_of_q, double tolerance, PointsOnSegments& result) {
  const Vec3& q = end_of_q == SegmentFeature::V0 ? q0 : q1;
  const PointOnSegment on_p = project_on_segment(q, p0, p1, tolerance);
  result.p = on_p.point;
  result.feature_p = on_p.feature;
  result.overlap_length = 0.0;
  if (on_p.feature == SegmentFeature::EDGE) {
    result.q = q;
    result.feature_q = end_of_q;
    result.squared_distance = on_p.squared_distance;
    result.squared_rise = on_p.squared_rise;
  } else {
    const PointOnSegment on_q = project_on_segment(on_p.point, q0, q1, tolerance);
    result.q = on_q.point;
    result.feature_q = on_q.feature;
    result.squared_distance = on_q.squared_distance;
    result.squared_rise = on_q.squared_rise;
  }
}

/// Closest pair that has the end p of one segment: only the other segment is projected on.
inline void pair_from_end_of_p(const Vec3& p, SegmentFeature end_of_p, const Vec3& q0, const Vec3& q1,
                               double tolerance, PointsOnSegments& result) {
  const PointOnSegment on_q = project_on_segment(p, q0, q1, tolerance);
  result.p = p;
  result.feature_p = end_of_p;
  result.q = on_q.point;
  result.feature_q = on_q.feature;
  result.squared_distance = on_q.squared_distance;
  result.squared_rise = on_q.squared_rise;
  result.overlap_length = 0.0;
}

/// Segments that drift apart by less than `tolerance` over the length of q; p is the longer one.
inline void parallel_segments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1,
                              double squared_length, double tolerance, PointsOnSegments& result) {
  const Vec3 d = p1 - p0;
  const double along_q0 = (q0 - p0).dot(d) / squared_length;
  const double along_q1 = (q1 - p0).dot(d) / squared_length;
  const double begin = std::max(0.0, std::min(along_q0, along_q1));
  const double end = std::min(1.0, std::max(along_q0, along_q1));
  const double overlap = (end - begin) * std::sqrt(squared_length);
  if (overlap > tolerance) {
    const double middle = 0.5 * (begin + end);
    const double t = std::clamp((middle - along_q0) / (along_q1 - along_q0), 0.0, 1.0);
    result.p = p0 + middle * d;
    result.q = q0 + t * (q1 - q0);
    result.squared_distance = (result.p - result.q).squaredNorm();
    result.overlap_length = overlap;
    result.squared_rise = 0.0;
    result.feature_p = result.feature_q = SegmentFeature::EDGE;
    return;
  }
  // They overlap in a point at most, or q is shorter than the tolerance: some end is a minimiser.
  pair_from_end_of_q(p0, p1, q0, q1, SegmentFeature::V0, tolerance, result);
  PointsOnSegments other;
  pair_from_end_of_q(p0, p1, q0, q1, SegmentFeature::V1, tolerance, other);
  if (other.squared_distance < result.squared_distance) result = other;
}

/// Closest points of the segments p0 p1 and q0 q1, p being the longer one.
/// - Split d2 = q1 - q0 and r = q0 - p0 into parts along and across d1 = p1 - p0. Across, the lines
///   are a point and a line: t = -(r' . d2') / (d2' . d2') is the point of q's line nearest to p's.
///   The textbook denominator |d1|^2 |d2|^2 - (d1 . d2)^2 is the same number but loses the angle
///   below 1e-8; this form errs by a few roundings of the segments' length at any angle.
/// - Clamp t, project on p, clamp, project back (C. Ericson, "Real-Time Collision Detection", 2005,
///   section 5.1.9): each step is a feasible pair, the last a convex function's minimum on the box.
inline void ordered_segment_distance(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1,
                                     double squared_length_p, double squared_length_q, double tolerance,
                                     PointsOnSegments& result) {
  const Vec3 d1 = p1 - p0;
  const Vec3 d2 = q1 - q0;
  const Vec3 r = q0 - p0;
  const double squared_tolerance = tolerance * tolerance;
  if (!(squared_length_p > squared_tolerance)) {
    // Both are points up to rounding; their lengths cannot be divided by.
    pair_from_end_of_p(p0, SegmentFeature::V0, q0, q1, tolerance, result);
    PointsOnSegments other;
    pair_from_end_of_p(p1, SegmentFeature::V1, q0, q1, tolerance, other);
    if (other.squared_distance < result.squared_distance) result = other;
    return;
  }
  const double inverse = 1.0 / squared_length_p;
  const double mu = d1.dot(d2) * inverse;
  const double sigma = d1.dot(r) * inverse;
  const Vec3 d2_across = d2 - mu * d1;
  const double squared_across = d2_across.squaredNorm();
  if (squared_across <= squared_tolerance) {
    return parallel_segments(p0, p1, q0, q1, squared_length_p, tolerance, result);
  }
  const Vec3 r_across = r - sigma * d1;
  const double t = -r_across.dot(d2_across) / squared_across;
  if (t <= 0.0 || t * t * squared_length_q <= squared_tolerance) {
    return pair_from_end_of_q(p0, p1, q0, q1, SegmentFeature::V0, tolerance, result);
  }
  if (t >= 1.0 || (1.0 - t) * (1.0 - t) * squared_length_q <= squared_tolerance) {
    return pair_from_end_of_q(p0, p1, q0, q1, SegmentFeature::V1, tolerance, result);
  }
  const double s = sigma + t * mu;
  if (s <= 0.0 || s * s * squared_length_p <= squared_tolerance) {
    return pair_from_end_of_p(p0, SegmentFeature::V0, q0, q1, tolerance, result);
  }
  if (s >= 1.0 || (1.0 - s) * (1.0 - s) * squared_length_p <= squared_tolerance) {
    return pair_from_end_of_p(p1, SegmentFeature::V1, q0, q1, tolerance, result);
  }
  // Towards an end of q the lines drift apart by squared_across per unit of t, towards
  // an end of the longer p by more.
  const double least_part = std::min(std::min(t, 1.0 - t), std::min(s, 1.0 - s));
  result.squared_rise = least_part * least_part * squared_across;
  result.p = p0 + s * d1;
  result.q = q0 + t * d2;
  result.squared_distance = (result.p - result.q).squaredNorm();
  result.overlap_length = 0.0;
  result.feature_p = result.feature_q = SegmentFeature::EDGE;
}

/// Two segments in any order of length. The longer one is p of the result and coordinates break
/// ties, so the order of the arguments does not matter.
/// @returns true when the first segment has the role p
inline bool segment_pair(const Vec3& a0, const Vec3& a1, double squared_length_a, const Vec3& b0,
                         const Vec3& b1, double squared_length_b, double tolerance,
                         PointsOnSegments& result) {
  LMDBENCH_EXPECTS(!lexicographic_less(a1, a0) && !lexicographic_less(b1, b0),
                   "ends that the caller did not order: the same segments would give other bits");
  bool a_first = squared_length_a > squared_length_b;
  if (squared_length_a == squared_length_b) {
    a_first = a0 != b0 ? lexicographic_less(a0, b0) : lexicographic_less(a1, b1);
  }
  // Selected by address: which edge is longer is random, so no branch should depend on it.
  ordered_segment_distance(a_first ? a0 : b0, a_first ? a1 : b1, a_first ? b0 : a0, a_first ? b1 : a1,
                           a_first ? squared_length_a : squared_length_b,
                           a_first ? squared_length_b : squared_length_a, tolerance, result);
  return a_first;
}

inline bool segment_pair(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1, double tolerance,
                         PointsOnSegments& result) {
  return segment_pair(a0, a1, (a1 - a0).squaredNorm(), b0, b1, (b1 - b0).squaredNorm(), tolerance, result);
}

}  // namespace lmdbench::kernel
