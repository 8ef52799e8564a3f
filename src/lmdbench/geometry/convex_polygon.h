// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/types.h>

#include <limits>
#include <span>
#include <vector>

namespace lmdbench {

using Vec2 = Eigen::Vector2d;

/// Twice the area of the triangle of the origin, a and b: positive where b lies to the left of a.
inline double cross(const Vec2& a, const Vec2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// Axis-aligned box of the plane; empty until a point is added.
struct Box2 {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec2& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  bool comes_within(const Box2& other, double within) const {
    return low[0] <= other.high[0] + within && other.low[0] <= high[0] + within &&
           low[1] <= other.high[1] + within && other.low[1] <= high[1] + within;
  }
};

/// Coordinates in a plane square to a direction.
struct PlanarFrame {
  Vec3 origin, u, v;

  /// @param n unit vector; seen against it u turns to v counter-clockwise
  PlanarFrame(const Vec3& point, const Vec3& n) : origin(point), u(n.unitOrthogonal()), v(n.cross(u)) {
    LMDBENCH_EXPECTS(is_unit(n), "a normal of a region without area, or not normalised");
  }

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

/// Corners of the convex hull, counter-clockwise, none on the line of its neighbours (Andrew 1979).
/// @param points  changes their order
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

/// Least distance of two parallel lines that hold a convex polygon between them [m].
double width_of(std::span<const Vec2> hull);

/// Corner of a convex hull (`convex_hull`) farthest along an axis; logarithmic in the corners.
const Vec2& farthest_along(std::span<const Vec2> hull, const Vec2& axis);

/// Convex polygon in a plane, corners counter-clockwise.
struct ConvexPolygon {
  std::vector<Vec2> corners;

  ConvexPolygon() = default;
  explicit ConvexPolygon(std::vector<Vec2> points) : corners(std::move(points)) {}
  /// Projection of a triangle, turned over where it runs clockwise.
  ConvexPolygon(const PlanarFrame& frame, const Triangle& triangle);

  /// The part that both have: every side of the other cuts this one (Sutherland and Hodgman 1974).
  /// It has no corners where the polygons do not overlap.
  ConvexPolygon cut_by(const ConvexPolygon& other) const;
  /// The part of the segment from p to q that lies inside.
  /// @param within  how far outside a side's line still counts as inside, and twice that beyond
  ///   where the polygon begins and ends along the segment [m]
  SegmentPart part_of(const Vec2& p, const Vec2& q, double within = 0.0) const;
  AreaAndCentroid measure() const { return area_and_centroid(corners); }
  Box2 box() const;
  /// The point on a side nearest to x. @pre it has corners
  Vec2 nearest_on_sides(const Vec2& x) const;
  /// Whether a point is no farther away than `within` [m].
  bool holds(const Vec2& x, double within) const;
  /// Whether the two are no farther apart than `within` [m].
  bool touches(const ConvexPolygon& other, double within) const;
};

}  // namespace lmdbench
