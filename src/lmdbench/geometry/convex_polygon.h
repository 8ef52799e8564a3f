// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <span>
#include <vector>

namespace lmdbench {

using Vec2 = Eigen::Vector2d;

/// Twice the area of the triangle of the origin, a and b: positive where b lies to the left of a.
inline double cross(const Vec2& a, const Vec2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// Coordinates in a plane square to a direction.
struct PlanarFrame {
  Vec3 origin, u, v;

  /// @param n unit vector; seen against it u turns to v counter-clockwise
  PlanarFrame(const Vec3& point, const Vec3& n) : origin(point), u(n.unitOrthogonal()), v(n.cross(u)) {}

  Vec2 flat(const Vec3& x) const { return {u.dot(x - origin), v.dot(x - origin)}; }
  Vec3 lifted(const Vec2& x) const { return origin + x[0] * u + x[1] * v; }
};

struct AreaAndCentroid {
  double area = 0.0;  ///< m^2
  Vec2 centroid = Vec2::Zero();
};

/// Of a convex polygon with corners counter-clockwise; nothing for fewer than three.
AreaAndCentroid area_and_centroid(std::span<const Vec2> corners);

/// Part of a segment, by parameters from 0 at its first end to 1; empty where end <= begin.
struct SegmentPart {
  double begin = 0.0, end = 0.0;
};

/// Convex polygon in a plane, corners counter-clockwise.
struct ConvexPolygon {
  std::vector<Vec2> corners;

  ConvexPolygon() = default;
  explicit ConvexPolygon(std::vector<Vec2> points) : corners(std::move(points)) {}
  /// Projection of a triangle, turned over where it runs clockwise.
  ConvexPolygon(const PlanarFrame& frame, const Triangle& triangle);

  /// The common part: every side of the other cuts this one (Sutherland and Hodgman 1974). Without corners
  /// where there is none.
  ConvexPolygon cut_by(const ConvexPolygon& other) const;
  /// The part of the segment from p to q that lies inside.
  SegmentPart part_of(const Vec2& p, const Vec2& q) const;
  AreaAndCentroid measure() const { return area_and_centroid(corners); }
};

}  // namespace lmdbench
