// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/expansion.h>
#include <lmdbench/geometry/face_frame.h>
#include <lmdbench/geometry/orientation.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_intersection.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

// Two closed triangles share a point exactly when an edge of one shares a point with the other (an
// edge may lie in the other's plane; a triangle without area is an edge or a point). Every answer
// below is a sign of orientation_2d or orientation_3d: exact, and free of contradictions.
namespace lmdbench {
namespace {

constexpr int COLLINEAR = -1;

/// A coordinate axis along which abc projects to a triangle with area; COLLINEAR without one.
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
  // The line meets the plane in one point, which is inside when all three edges turn the same way.
  const int s0 = orientation_3d(p[0], p[1], t[0], t[1]);
  const int s1 = orientation_3d(p[0], p[1], t[1], t[2]);
  const int s2 = orientation_3d(p[0], p[1], t[2], t[0]);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

/// A triangle without area as a segment.
Segment collinear_hull(const Triangle& t) {
  const auto [low, high] = std::minmax_element(t.begin(), t.end(), lexicographic_less);
  return {*low, *high};
}

std::array<Segment, 3> edges(const Triangle& t) {
  return {Segment{t[0], t[1]}, Segment{t[1], t[2]}, Segment{t[2], t[0]}};
}

/// The sides of the other triangle's plane on which each triangle's corners are; exact.
struct Sides {
  std::array<int, 3> a{}, b{};

  Sides(const Triangle& ta, const Triangle& tb) {
    b = sides_of_plane(ta, tb);
    if (!apart(b)) a = sides_of_plane(tb, ta);
  }

  static bool apart(const std::array<int, 3>& side) {
    return side[0] != 0 && side[0] == side[1] && side[1] == side[2];
  }
  /// One plane has the other triangle strictly on one side.
  bool planes_separate() const { return apart(b) || apart(a); }
  /// No corner lies in the other's plane.
  bool is_generic() const { return a[0] * a[1] * a[2] * b[0] * b[1] * b[2] != 0; }
};

int lone_corner(const std::array<int, 3>& side) {
  return side[1] == side[2] ? 0 : side[2] == side[0] ? 1 : 2;
}

/// Each triangle cuts the line that the planes share in a segment; do the segments overlap? p is
/// the corner alone on its side, and both triangles are turned so that each p is above the other's
/// plane. Then two orientations compare the ends of the segments (P. Guigue and O. Devillers, "Fast
/// and robust triangle-triangle overlap test using orientation predicates", 2003).
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

/// See triangles_intersect.
constexpr double TINY_PART = 0x1p-200;

bool has_tiny_coordinate(const Triangle& triangle, double limit) {
  return std::any_of(triangle.begin(), triangle.end(), [limit](const Vec3& corner) {
    return (corner.array() != 0.0 && corner.array().abs() < limit).any();
  });
}

Triangle without_tiny_coordinates(const Triangle& triangle, double limit) {
  Triangle result;
  for (int k = 0; k < 3; ++k) {
    result[k] = triangle[k].unaryExpr([limit](double x) { return std::abs(x) < limit ? 0.0 : x; });
  }
  return result;
}

bool exactly_intersect(const Triangle& a, const Triangle& b) {
  const Sides sides(a, b);
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

}  // namespace

bool triangles_intersect(const Triangle& a, const Triangle& b) {
  const double limit = TINY_PART * std::max(largest_coordinate(a), largest_coordinate(b));
  if (has_tiny_coordinate(a, limit) || has_tiny_coordinate(b, limit)) {
    return exactly_intersect(without_tiny_coordinates(a, limit), without_tiny_coordinates(b, limit));
  }
  return exactly_intersect(a, b);
}

namespace {

/// Sign of component `axis` of (q - p) x (v - u); exact.
int cross_sign(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return (exact_difference(q[i], p[i]) * exact_difference(v[j], u[j]) -
          exact_difference(q[j], p[j]) * exact_difference(v[i], u[i]))
      .sign();
}

/// Side of t's plane on which p is once displaced by `step` times the infinitely small vector.
int displaced_side(const Triangle& t, const Vec3& p, int step) {
  const int side = orientation_3d(t[0], t[1], t[2], p);
  if (side != 0) return side;
  // The derivative is the plane's normal, whose components are areas of projections.
  for (int axis = 0; axis < 3; ++axis) {
    const int normal = orientation_2d(t[0], t[1], t[2], axis);
    if (normal != 0) return step * normal;
  }
  return 0;
}

/// orientation_3d(p, q, u, v) once p and q are displaced; 0 only where pq and uv are parallel.
int displaced_turn(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, int step) {
  const int turn = orientation_3d(p, q, u, v);
  if (turn != 0) return turn;
  // det(q - p, u - p - d, v - p - d) is linear in d: its derivative is (q - p) x (v - u).
  for (int axis = 0; axis < 3; ++axis) {
    const int derivative = cross_sign(p, q, u, v, axis);
    if (derivative != 0) return step * derivative;
  }
  return 0;
}

}  // namespace

bool pierces(const Segment& segment, PiercingBody body, const Triangle& triangle) {
  const int step = static_cast<int>(body);
  const int side_0 = displaced_side(triangle, segment[0], step);
  if (side_0 == 0 || displaced_side(triangle, segment[1], step) != -side_0) return false;
  const int turn = displaced_turn(segment[0], segment[1], triangle[0], triangle[1], step);
  return turn != 0 && displaced_turn(segment[0], segment[1], triangle[1], triangle[2], step) == turn &&
         displaced_turn(segment[0], segment[1], triangle[2], triangle[0], step) == turn;
}

Vec3 piercing_point(const Segment& segment, const Triangle& triangle) {
  const kernel::FaceFrame face(triangle, 0.0);
  if (!face.has_face) return segment[0];
  const Vec3 normal = face.e.cross(face.h);
  const double h0 = normal.dot(segment[0] - face.a), h1 = normal.dot(segment[1] - face.a);
  // From the nearer end, where the division is more accurate.
  const bool from_0 = std::abs(h0) <= std::abs(h1);
  const double near = from_0 ? h0 : h1, far = from_0 ? h1 : h0;
  const Vec3& begin = segment[from_0 ? 0 : 1];
  const Vec3& end = segment[from_0 ? 1 : 0];
  // Heights are rounding, though exact signs differ: any point of the segment is on the plane.
  if (!(near * far < 0.0)) return begin;
  return begin + near / (near - far) * (end - begin);
}

}  // namespace lmdbench
