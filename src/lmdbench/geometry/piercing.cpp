// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/expansion.h>
#include <lmdbench/geometry/face_frame.h>
#include <lmdbench/geometry/orientation.h>
#include <lmdbench/geometry/piercing.h>

#include <cmath>

namespace lmdbench {

namespace {

/// Sign of component `axis` of (q - p) x (v - u); exact.
int cross_sign(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return (exact_difference(q[i], p[i]) * exact_difference(v[j], u[j]) -
          exact_difference(q[j], p[j]) * exact_difference(v[i], u[i]))
      .sign();
}

/// Side of the plane of t on which p is, after p has been displaced by `step` times the infinitely small vector.
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

/// orientation_3d(p, q, u, v) after p and q have been displaced; 0 only where pq and uv are parallel.
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
  // From the nearer end, where the division is the more accurate.
  const bool from_0 = std::abs(h0) <= std::abs(h1);
  const double near = from_0 ? h0 : h1, far = from_0 ? h1 : h0;
  const Vec3& begin = segment[from_0 ? 0 : 1];
  const Vec3& end = segment[from_0 ? 1 : 0];
  // Heights of rounding, which the exact signs tell apart: anywhere on the segment is on the plane.
  if (!(near * far < 0.0)) return begin;
  return begin + near / (near - far) * (end - begin);
}

}  // namespace lmdbench
