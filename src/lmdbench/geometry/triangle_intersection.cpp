// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/orientation.h>
#include <lmdbench/geometry/shared_segment.h>
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

using kernel::Sides;

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

int lone_corner(const std::array<int, 3>& side) {
  return side[1] == side[2] ? 0 : side[2] == side[0] ? 1 : 2;
}

/// Each triangle cuts the line that the two planes share in a segment; do the segments overlap? p is the
/// corner that is alone on its side, and both triangles are turned so that p of each is above the other's
/// plane; then two orientations compare the ends of the segments (P. Guigue and O. Devillers, "Fast and
/// robust triangle-triangle overlap test using orientation predicates", 2003).
/// @pre sides.is_generic() and not sides.planes_separate()
bool segments_on_common_line_overlap(const Triangle& a, const Triangle& b, const Sides& sides) {
  const int lone_a = lone_corner(sides.a);
  const int lone_b = lone_corner(sides.b);
  const bool turn_a = sides.b[lone_b] < 0;
  const bool turn_b = sides.a[lone_a] < 0;
  const Vec3& pa = a[lone_a];
  const Vec3& qa = a[(lone_a + (turn_a ? 2 : 1)) % 3];
  const Vec3& ra = a[(lone_a + (turn_a ? 1 : 2)) % 3];
  const Vec3& pb = b[lone_b];
  const Vec3& qb = b[(lone_b + (turn_b ? 2 : 1)) % 3];
  const Vec3& rb = b[(lone_b + (turn_b ? 1 : 2)) % 3];
  return orientation_3d(pa, qa, pb, qb) <= 0 && orientation_3d(pa, ra, rb, pb) <= 0;
}

/// Point where an edge that meets the triangle's plane in one point does so.
Vec3 piercing_point(const Segment& p, const Triangle& t, const Vec3& normal) {
  const double height_0 = std::abs(normal.dot(p[0] - t[0]));
  const double height_1 = std::abs(normal.dot(p[1] - t[0]));
  const double sum = height_0 + height_1;
  if (!(sum > 0.0)) return p[0];
  // From the nearer end, where the division is the more accurate.
  const int nearer = height_0 <= height_1 ? 0 : 1;
  return p[nearer] + ((nearer == 0 ? height_0 : height_1) / sum) * (p[1 - nearer] - p[nearer]);
}

/// The piece of the planes' common line that both triangles cover.
/// @pre sides.is_generic() and the triangles intersect
Segment overlap_on_common_line(const Triangle& first, const Triangle& second, const Sides& sides) {
  const Vec3 normal_first = (first[1] - first[0]).cross(first[2] - first[0]);
  const Vec3 normal_second = (second[1] - second[0]).cross(second[2] - second[0]);
  const Vec3 along = normal_first.cross(normal_second);
  const auto ends = [&along](const Triangle& t, int lone, const Triangle& other, const Vec3& normal) {
    Segment segment{piercing_point({t[lone], t[(lone + 1) % 3]}, other, normal),
                    piercing_point({t[lone], t[(lone + 2) % 3]}, other, normal)};
    if (along.dot(segment[1] - segment[0]) < 0.0) std::swap(segment[0], segment[1]);
    return segment;
  };
  const Segment on_first = ends(first, lone_corner(sides.a), second, normal_second);
  const Segment on_second = ends(second, lone_corner(sides.b), first, normal_first);
  Segment shared{along.dot(on_second[0] - on_first[0]) > 0.0 ? on_second[0] : on_first[0],
                 along.dot(on_second[1] - on_first[1]) < 0.0 ? on_second[1] : on_first[1]};
  if (lexicographic_less(shared[1], shared[0])) std::swap(shared[0], shared[1]);
  return shared;
}

void collect_piercing_points(const Triangle& piercing, const Triangle& t, int axis,
                             std::array<Vec3, 6>& points, int& count) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  for (const auto& ends : kernel::EDGE_ENDS) {
    const Segment edge{piercing[ends[0]], piercing[ends[1]]};
    if (!segment_meets_triangle(edge, t, axis)) continue;
    const bool in_plane =
        orientation_3d(t[0], t[1], t[2], edge[0]) == 0 && orientation_3d(t[0], t[1], t[2], edge[1]) == 0;
    // An edge in the other's plane: the pieces of the shared segment come from the other triangle's edges.
    if (!in_plane) points[count++] = piercing_point(edge, t, normal);
  }
}

}  // namespace

bool triangles_intersect(const Triangle& a, const Triangle& b) {
  return kernel::triangles_intersect(a, b, Sides(a, b));
}

std::optional<Segment> intersection_segment(const Triangle& a, const Triangle& b) {
  // Sorted, so that neither the order of corners nor that of the arguments changes a bit.
  Triangle first = kernel::SortedTriangle(a).corners;
  Triangle second = kernel::SortedTriangle(b).corners;
  if (std::lexicographical_compare(second.begin(), second.end(), first.begin(), first.end(),
                                   lexicographic_less)) {
    std::swap(first, second);
  }
  const Sides sides(first, second);
  if (!kernel::triangles_intersect(first, second, sides)) return std::nullopt;
  return kernel::shared_segment(first, second, sides);
}

namespace kernel {

Sides::Sides(const Triangle& ta, const Triangle& tb) {
  b = sides_of_plane(ta, tb);
  if (!apart(b)) a = sides_of_plane(tb, ta);
}

bool triangles_intersect(const Triangle& a, const Triangle& b, const Sides& sides) {
  if (sides.planes_separate()) return false;
  if (sides.is_generic()) return segments_on_common_line_overlap(a, b, sides);
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

std::optional<Segment> shared_segment(const Triangle& first, const Triangle& second, const Sides& sides) {
  std::array<Vec3, 6> points;
  int count = 0;
  if (sides.is_generic()) return overlap_on_common_line(first, second, sides);
  const int axis_first = projection_axis(first[0], first[1], first[2]);
  const int axis_second = projection_axis(second[0], second[1], second[2]);
  if (axis_first == COLLINEAR || axis_second == COLLINEAR) return std::nullopt;
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

}  // namespace kernel

}  // namespace lmdbench
