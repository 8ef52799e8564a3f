// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/orientation.h>
#include <lmdbench/geometry/sorted_triangle.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_intersection.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

// Two closed triangles share a point exactly when an edge of one shares a point with the other (an edge may
// lie in the other's plane, and a triangle without area is an edge or a point). Every question below is a
// sign of orientation_2d or orientation_3d, so the answers are exact and cannot contradict each other.

namespace lmdbench {
namespace {

constexpr int COLLINEAR = -1;

/// A coordinate axis along which abc projects to a triangle with area; COLLINEAR when there is none.
int projection_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  int best = 0;
  normal.cwiseAbs().maxCoeff(&best);
  for (int step = 0; step < 3; ++step) {
    const int axis = (best + step) % 3;
    if (orientation_2d(a, b, c, axis) != 0) return axis;
  }
  return COLLINEAR;
}

bool in_triangle_2d(const Vec3& p, const Triangle& t, int axis) {
  const int s0 = orientation_2d(t[0], t[1], p, axis);
  const int s1 = orientation_2d(t[1], t[2], p, axis);
  const int s2 = orientation_2d(t[2], t[0], p, axis);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

/// For points of one line: their extents overlap along every axis.
bool extents_overlap(const Segment& p, const Segment& q) {
  return ((p[0].cwiseMin(p[1]).array() <= q[0].cwiseMax(q[1]).array()) &&
          (q[0].cwiseMin(q[1]).array() <= p[0].cwiseMax(p[1]).array()))
      .all();
}

/// Coplanar segments, seen along an axis that keeps their plane's points apart.
bool segments_meet_2d(const Segment& p, const Segment& q, int axis) {
  const int q0_to_p = orientation_2d(p[0], p[1], q[0], axis);
  const int q1_to_p = orientation_2d(p[0], p[1], q[1], axis);
  if (q0_to_p * q1_to_p > 0) return false;
  const int p0_to_q = orientation_2d(q[0], q[1], p[0], axis);
  const int p1_to_q = orientation_2d(q[0], q[1], p[1], axis);
  if (p0_to_q * p1_to_q > 0) return false;
  if (q0_to_p == 0 && q1_to_p == 0 && p0_to_q == 0 && p1_to_q == 0) return extents_overlap(p, q);
  return true;
}

bool segments_meet(const Segment& p, const Segment& q) {
  if (orientation_3d(p[0], p[1], q[0], q[1]) != 0) return false;
  for (const auto& [a, b, c] : {std::array{p[0], p[1], q[0]}, std::array{p[0], p[1], q[1]},
                                std::array{q[0], q[1], p[0]}, std::array{q[0], q[1], p[1]}}) {
    const int axis = projection_axis(a, b, c);
    if (axis != COLLINEAR) return segments_meet_2d(p, q, axis);
  }
  return extents_overlap(p, q);
}

/// @param axis projection_axis of t, which has area
bool segment_meets_triangle(const Segment& p, const Triangle& t, int axis) {
  const int side_0 = orientation_3d(t[0], t[1], t[2], p[0]);
  const int side_1 = orientation_3d(t[0], t[1], t[2], p[1]);
  if (side_0 * side_1 > 0) return false;
  if (side_0 == 0 && side_1 == 0) {
    return in_triangle_2d(p[0], t, axis) || in_triangle_2d(p[1], t, axis) ||
           segments_meet_2d(p, {t[0], t[1]}, axis) || segments_meet_2d(p, {t[1], t[2]}, axis) ||
           segments_meet_2d(p, {t[2], t[0]}, axis);
  }
  if (side_0 == 0) return in_triangle_2d(p[0], t, axis);
  if (side_1 == 0) return in_triangle_2d(p[1], t, axis);
  // The line pierces the plane at one point, which is inside when it turns the same way round all three
  // edges.
  const int s0 = orientation_3d(p[0], p[1], t[0], t[1]);
  const int s1 = orientation_3d(p[0], p[1], t[1], t[2]);
  const int s2 = orientation_3d(p[0], p[1], t[2], t[0]);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

/// The segment that a triangle without area is.
Segment collinear_hull(const Triangle& t) {
  const auto [low, high] = std::minmax_element(t.begin(), t.end(), lexicographic_less);
  return {*low, *high};
}

std::array<Segment, 3> edges(const Triangle& t) {
  return {Segment{t[0], t[1]}, Segment{t[1], t[2]}, Segment{t[2], t[0]}};
}

bool all_strictly_on_one_side(const Triangle& plane, const Triangle& points) {
  const int side = orientation_3d(plane[0], plane[1], plane[2], points[0]);
  return side != 0 && orientation_3d(plane[0], plane[1], plane[2], points[1]) == side &&
         orientation_3d(plane[0], plane[1], plane[2], points[2]) == side;
}

/// Point where an edge that meets the triangle's plane in one point does so.
Vec3 piercing_point(const Segment& p, const Triangle& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double height_0 = std::abs(normal.dot(p[0] - t[0]));
  const double height_1 = std::abs(normal.dot(p[1] - t[0]));
  const double sum = height_0 + height_1;
  if (!(sum > 0.0)) return p[0];
  // From the nearer end, where the division is the more accurate.
  return height_0 <= height_1 ? Vec3(p[0] + (height_0 / sum) * (p[1] - p[0]))
                              : Vec3(p[1] + (height_1 / sum) * (p[0] - p[1]));
}

void collect_piercing_points(const Triangle& piercing, const Triangle& t, int axis,
                             std::array<Vec3, 6>& points, int& count) {
  for (const auto& ends : kernel::EDGE_ENDS) {
    const Segment edge{piercing[ends[0]], piercing[ends[1]]};
    if (!segment_meets_triangle(edge, t, axis)) continue;
    const bool in_plane =
        orientation_3d(t[0], t[1], t[2], edge[0]) == 0 && orientation_3d(t[0], t[1], t[2], edge[1]) == 0;
    // An edge in the other's plane: the pieces of the shared segment come from the other triangle's edges.
    if (!in_plane) points[count++] = piercing_point(edge, t);
  }
}

}  // namespace

bool triangles_intersect(const Triangle& a, const Triangle& b) {
  if (all_strictly_on_one_side(a, b) || all_strictly_on_one_side(b, a)) return false;
  const int axis_a = projection_axis(a[0], a[1], a[2]);
  const int axis_b = projection_axis(b[0], b[1], b[2]);
  if (axis_a == COLLINEAR && axis_b == COLLINEAR) return segments_meet(collinear_hull(a), collinear_hull(b));
  if (axis_a == COLLINEAR) return segment_meets_triangle(collinear_hull(a), b, axis_b);
  if (axis_b == COLLINEAR) return segment_meets_triangle(collinear_hull(b), a, axis_a);
  for (const Segment& edge : edges(a)) {
    if (segment_meets_triangle(edge, b, axis_b)) return true;
  }
  for (const Segment& edge : edges(b)) {
    if (segment_meets_triangle(edge, a, axis_a)) return true;
  }
  return false;
}

std::optional<Segment> intersection_segment(const Triangle& a, const Triangle& b) {
  if (!triangles_intersect(a, b)) return std::nullopt;
  // Sorted, so that neither the order of corners nor that of the arguments changes a bit.
  Triangle first = kernel::SortedTriangle(a).corners;
  Triangle second = kernel::SortedTriangle(b).corners;
  if (std::lexicographical_compare(second.begin(), second.end(), first.begin(), first.end(),
                                   lexicographic_less)) {
    std::swap(first, second);
  }
  const int axis_first = projection_axis(first[0], first[1], first[2]);
  const int axis_second = projection_axis(second[0], second[1], second[2]);
  if (axis_first == COLLINEAR || axis_second == COLLINEAR) return std::nullopt;
  std::array<Vec3, 6> points;
  int count = 0;
  collect_piercing_points(first, second, axis_second, points, count);
  collect_piercing_points(second, first, axis_first, points, count);
  if (count == 0) return std::nullopt;
  // All lie on one line up to rounding, which need not be the order that coordinates give; take the farthest
  // two.
  Segment longest{points[0], points[0]};
  double longest_squared = -1.0;
  for (int i = 0; i < count; ++i) {
    for (int j = i; j < count; ++j) {
      const double squared_length = (points[j] - points[i]).squaredNorm();
      if (squared_length > longest_squared) {
        longest_squared = squared_length;
        longest = {points[i], points[j]};
      }
    }
  }
  if (lexicographic_less(longest[1], longest[0])) std::swap(longest[0], longest[1]);
  return longest;
}

}  // namespace lmdbench
