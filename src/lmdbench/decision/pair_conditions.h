// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {

/// A chain at a pose.
struct Line {
  std::array<Vec3, 2> ends;
  Vec3 along;  ///< From the first end to the second.
  double length;

  Line(const ShapeSide& side, std::int32_t lead)
      : ends{side.vertex(side.ends_of_lead(lead)[0]), side.vertex(side.ends_of_lead(lead)[1])},
        along(ends[1] - ends[0]),
        length(along.norm()) {}
  Vec3 at(double parameter) const { return ends[0] + parameter * along; }
  /// How far the foot at a parameter is beyond an end; negative on the chain [m].
  double beyond(double parameter) const { return std::max(-parameter, parameter - 1.0) * length; }
};

// How a direction d from one feature to the other is known, so how it changes with the pose.

/// The difference of two points: changes with their displacement.
struct BetweenPoints {
  const Vec3 &from, &to;
};
/// From a point to its foot on a line, or back: changes with the displacement square to the line.
struct SquareToLine {
  const Vec3& point;
  const Line& line;
};
/// Along a plane's normal: turns with the mesh.
struct AlongNormal {
  const Vec3& point;   ///< The corner over it.
  const Vec3& normal;  ///< Of the plane, unit; d is against it.
};
/// Along the common perpendicular of two lines, at parameters s and t: turns as they turn.
struct Crossing {
  const Line &a, &b;  ///< Of the moving mesh and of the fixed one.
  Vec3 product;
  double sine, squared_product, s, t;

  Crossing(const Line& of_moving, const Line& of_fixed, const Vec3& of_lines, double sine_between)
      : a(of_moving),
        b(of_fixed),
        product(of_lines),
        sine(sine_between),
        squared_product(product.squaredNorm()) {
    const Vec3 r = b.ends[0] - a.ends[0];
    s = r.cross(b.along).dot(product) / squared_product;
    t = r.cross(a.along).dot(product) / squared_product;
  }
};

/// Conditions under which two features share a contact (DEFINITION.md), one text for the definition
/// (decide.cpp), the filter that rejects pairs and says for how long (certified/decide/filter.cpp),
/// and indices of critical pairs (critical_index.cpp). Each has its own slack and use of the rest.
///
/// A visitor gets conditions one by one until it answers false. `from` is the side of the
/// condition's point. A gradient is of the condition's value for a displacement of the moving mesh;
/// it is called when a pair is rejected.
///
/// | call | the value that must not be negative |
/// |---|---|
/// | is_long(line) | the line's length |
/// | near(from, p, q, d) | reach - abs d, d = q - p |
/// | above(from, height, gradient) | height of a point over a plane [m] |
/// | below_reach(from, height, gradient) | reach - height; gradient of the height |
/// | foot_on(from, p, line, parameter) | how far a foot is from the ends of a chain, inwards [m] |
/// | in_box(from, inside, gradient) | how far it is from the sides of a region's box, inwards [m] |
/// | in_triangle(from, inside, side, opposite, gradient) | the same of a triangle, times the side |
/// | crosses(lines, product, sine) | the sine between two lines, less what parallel ones have |
/// | feet_on(crossing) | how far both feet are from the ends, inwards [m] |
/// | perpendicular(crossing) | reach - its length; answers d, or nothing |
/// | parallel(sine) | largest tilt of the tolerance, less that of chain and plane or two planes |
/// | in_cone(from, lead, d, how) | - d . w / abs w for each wing w; d outwards |
///
/// A pair that passes all goes to one of the functions share_..., face_region or face_each_other.
template <class Visitor>
class PairConditions {
 public:
  explicit PairConditions(Visitor& visitor) : visit_(visitor) {}

  /// @param f, g  leads (ShapeComplex) on the moving and the fixed mesh
  void ask(const ShapeSide& moving, const FeatureId& f, const ShapeSide& fixed, const FeatureId& g) const {
    using enum FeatureKind;
    switch (f.kind) {
      case VERTEX:
        if (g.kind == VERTEX) return corner_corner(moving, f.index, fixed, g.index);
        if (g.kind == EDGE) return corner_chain(moving, f.index, fixed, g.index);
        return corner_region(moving, f.index, fixed, g.index);
      case EDGE:
        if (g.kind == VERTEX) return corner_chain(fixed, g.index, moving, f.index);
        if (g.kind == EDGE) return chain_chain(moving, f.index, fixed, g.index);
        return chain_region(moving, f.index, fixed, g.index);
      case FACE:
        if (g.kind == VERTEX) return corner_region(fixed, g.index, moving, f.index);
        if (g.kind == EDGE) return chain_region(fixed, g.index, moving, f.index);
        return region_region(moving, f.index, fixed, g.index);
    }
  }

 private:
  static FeatureId corner(std::int32_t vertex) { return {FeatureKind::VERTEX, vertex}; }
  static FeatureId chain(std::int32_t edge) { return {FeatureKind::EDGE, edge}; }

  void corner_corner(const ShapeSide& a, std::int32_t v, const ShapeSide& b, std::int32_t w) const {
    const Vec3 p = a.vertex(v), q = b.vertex(w), d = q - p;
    if (visit_.near(a, p, q, d) && visit_.in_cone(a, corner(v), d, BetweenPoints{p, q}) &&
        visit_.in_cone(b, corner(w), -d, BetweenPoints{q, p}))
      visit_.share_points(p, q, d);
  }

  void corner_chain(const ShapeSide& a, std::int32_t v, const ShapeSide& b, std::int32_t edge) const {
    const Line line(b, edge);
    if (!visit_.is_long(line)) return;
    const Vec3 p = a.vertex(v);
    const double parameter = (p - line.ends[0]).dot(line.along) / (line.length * line.length);
    if (!visit_.foot_on(a, p, line, parameter)) return;
    const Vec3 q = line.at(visit_.clamped(parameter)), d = q - p;
    if (visit_.near(a, p, q, d) && visit_.in_cone(a, corner(v), d, SquareToLine{p, line}) &&
        visit_.in_cone(b, chain(edge), -d, SquareToLine{p, line}))
      visit_.share_foot(a, b, p, q, line, parameter);
  }

  void corner_region(const ShapeSide& a, std::int32_t v, const ShapeSide& b, std::int32_t face) const {
    const Plane plane = b.plane_of_lead(face);
    if (!visit_.has_area(plane)) return;
    const Vec3 p = a.vertex(v);
    const double height = plane.height(p);
    const auto rise = [&] { return Vec3(a.sign() * plane.normal); };
    if (visit_.above(a, height, rise) && visit_.below_reach(a, height, rise) &&
        foot_in_bounds(a, p, b, face, plane) &&
        visit_.in_cone(a, corner(v), -plane.normal, AlongNormal{p, plane.normal}))
      visit_.share_height(a, p, b, plane, height);
  }

  /// In the triangle, or in the box of a larger region; share_height has the last word.
  bool foot_in_bounds(const ShapeSide& a, const Vec3& p, const ShapeSide& b, std::int32_t face,
                      const Plane& plane) const {
    if (const RegionShape* shape = b.shape_of_lead(face)) {
      const Vec2 low = shape->triangle_grid.low(), high = shape->triangle_grid.high(),
                 x = shape->frame.flat(b.point_to_surface(p));
      for (int k = 0; k < 2; ++k) {
        const auto axis = [&](double sense) {
          return Vec3(sense * a.sign() * b.direction(k == 0 ? shape->frame.u : shape->frame.v));
        };
        if (!visit_.in_box(a, high[k] - x[k], [&] { return axis(-1.0); }) ||
            !visit_.in_box(a, x[k] - low[k], [&] { return axis(1.0); }))
          return false;
      }
      return true;
    }
    const auto& corners = b.surface.mesh.triangles[static_cast<std::size_t>(face)];
    const std::array<Vec3, 3> x{plane.point, b.vertex(corners[1]), b.vertex(corners[2])};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = x[(k + 1) % 3] - x[k], opposite = x[(k + 2) % 3] - x[k];
      if (!visit_.in_triangle(a, side.cross(p - x[k]).dot(plane.normal), side, opposite,
                              [&] { return Vec3(a.sign() * plane.normal.cross(side)); }))
        return false;
    }
    return true;
  }

  void chain_chain(const ShapeSide& a, std::int32_t edge_a, const ShapeSide& b, std::int32_t edge_b) const {
    const Line line_a(a, edge_a), line_b(b, edge_b);
    if (!visit_.is_long(line_a) || !visit_.is_long(line_b)) return;
    const Vec3 product = line_a.along.cross(line_b.along);
    const double sine = product.norm() / (line_a.length * line_b.length);
    if (!visit_.crosses(line_a, line_b, product, sine)) return;
    const Crossing crossing(line_a, line_b, product, sine);
    if (!visit_.feet_on(crossing)) return;
    const auto d = visit_.perpendicular(crossing);
    if (d && visit_.in_cone(a, chain(edge_a), *d, crossing) &&
        visit_.in_cone(b, chain(edge_b), -*d, crossing))
      visit_.share_perpendicular(crossing);
  }

  void chain_region(const ShapeSide& a, std::int32_t edge, const ShapeSide& b, std::int32_t face) const {
    const Plane plane = b.plane_of_lead(face);
    if (!visit_.has_area(plane)) return;
    const Line line(a, edge);
    if (!visit_.is_long(line)) return;
    const double slope = line.along.dot(plane.normal) / line.length;
    if (!visit_.parallel(std::abs(slope))) return;
    const double first = plane.height(line.ends[0]), second = first + slope * line.length;
    const auto rise = [&] { return Vec3(a.sign() * plane.normal); };
    if (visit_.above(a, std::max(first, second), rise) &&
        visit_.below_reach(a, std::min(first, second), rise))
      visit_.face_region(a, line, b, plane, slope);
  }

  void region_region(const ShapeSide& a, std::int32_t face_a, const ShapeSide& b, std::int32_t face_b) const {
    const Plane plane_a = a.plane_of_lead(face_a), plane_b = b.plane_of_lead(face_b);
    if (visit_.has_area(plane_a) && visit_.has_area(plane_b) &&
        visit_.parallel((plane_a.normal + plane_b.normal).norm()))
      visit_.face_each_other(plane_a, plane_b);
  }

  Visitor& visit_;
};

}  // namespace lmdbench
