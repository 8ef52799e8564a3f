// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/geometry/extent.h>
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/lmd/minimiser_set.h>
#include <lmdbench/lmd/plateau.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lmdbench {

namespace {

/// Gap, relative to the coordinates, that rounding may leave between sets of minimisers that touch.
constexpr double TOUCHING_SETS = 1e-9;

/// Share of the gap by which polygons are widened, so that rounding does not part what meets along a line.
constexpr double WIDENING = 0.01;

/// A part that reaches no farther than so many gaps from the minimum's own point is that point.
constexpr double POINT_GAPS = 10.0;

/// What of a triangle lies within `reach` of the plane through p square to n.
std::vector<Vec3> near_plane(const Triangle& triangle, const Vec3& p, const Vec3& n, double reach) {
  std::vector<Vec3> kept(triangle.begin(), triangle.end()), cut;
  for (const double sign : {1.0, -1.0}) {
    cut.clear();
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const Vec3 &from = kept[i], &to = kept[(i + 1) % kept.size()];
      const double inside_from = reach - sign * n.dot(from - p), inside_to = reach - sign * n.dot(to - p);
      if (inside_from >= 0.0) cut.push_back(from);
      if ((inside_from > 0.0 && inside_to < 0.0) || (inside_from < 0.0 && inside_to > 0.0))
        cut.push_back(from + inside_from / (inside_from - inside_to) * (to - from));
    }
    kept.swap(cut);
  }
  return kept;
}

double area_of(const std::vector<Vec2>& corners) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec2 a = corners[i] - corners[0], b = corners[i + 1] - corners[0];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * twice;
}

/// A convex polygon whose sides were moved outwards, with blunt corners.
ConvexPolygon widened(const std::vector<Vec2>& corners, double by) {
  ConvexPolygon result;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 &from = corners[k], &to = corners[(k + 1) % corners.size()];
    const double length = (to - from).norm();
    if (!(length > 0.0)) continue;
    const Vec2 outwards = by / length * Vec2((to - from)[1], (from - to)[0]);
    result.corners.push_back(from + outwards);
    result.corners.push_back(to + outwards);
  }
  return result;
}

/// The corners of a convex polygon, counter-clockwise, a little widened; one that is narrower than the gap, such as the edge of a steep
/// triangle, as a strip of twice that width, because a polygon without area cuts nothing.
ConvexPolygon with_width(std::vector<Vec2> corners, double gap) {
  double area = area_of(corners);
  if (area < 0.0) {
    std::reverse(corners.begin(), corners.end());
    area = -area;
  }
  Vec2 from = corners[0], to = corners[0];
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((corners[i] - corners[j]).squaredNorm() > (to - from).squaredNorm()) {
        from = corners[i];
        to = corners[j];
      }
  const double length = (to - from).norm();
  if (area > gap * length) return widened(corners, WIDENING * gap);
  const Vec2 along = length > 0.0 ? Vec2(gap / length * (to - from)) : Vec2(gap, 0.0);
  const Vec2 across(-along[1], along[0]);
  return ConvexPolygon(
      {from - along - across, to + along - across, to + along + across, from - along + across});
}

/// What of a triangle lies in the plane of contact, seen along its direction.
struct InContact {
  std::int32_t triangle;
  ConvexPolygon shape;
};

/// Those of the triangles round a feature.
std::vector<InContact> in_contact(const Surface& surface, const RigidTransform& X_WS,
                                  const FeatureId& feature, const Vec3& p, const PlanarFrame& frame_W,
                                  const Vec3& n, double reach, double gap) {
  std::vector<InContact> result;
  const Vec2 own = frame_W.flat(p);
  for (const std::int32_t t : surface.incident_triangles(feature)) {
    const Triangle triangle = X_WS.triangle(surface.mesh.triangle(t));
    double size = 0.0;
    for (const Vec3& corner : triangle) size = std::max(size, (corner - p).norm());
    std::vector<Vec2> corners;
    double farthest = 0.0;
    for (const Vec3& x : near_plane(triangle, p, n, reach + 1.5 * PARALLEL_TILT * size)) {
      corners.push_back(frame_W.flat(x));
      farthest = std::max(farthest, (corners.back() - own).norm());
    }
    if (farthest > POINT_GAPS * gap) result.push_back({t, with_width(std::move(corners), gap)});
  }
  return result;
}

/// Whether the sets are farther apart than the gap along the axis.
bool is_apart(const std::vector<Vec2>& a, const std::vector<Vec2>& b, const Vec2& axis, double gap) {
  const double length = axis.norm();
  if (!(length > 0.0)) return false;
  const Extent of_a = extent_along(a, axis), of_b = extent_along(b, axis);
  return std::max(of_b.least - of_a.greatest, of_a.least - of_b.greatest) > gap * length;
}

/// Separating axes of convex polygons, segments and points: square to the sides, along segments, and between points.
bool is_apart(const std::vector<Vec2>& a, const std::vector<Vec2>& b, double gap) {
  if (is_apart(a, b, b.front() - a.front(), gap)) return true;
  for (const auto* set : {&a, &b}) {
    for (std::size_t k = 0; k < set->size() && set->size() > 1; ++k) {
      const Vec2 side = (*set)[(k + 1) % set->size()] - (*set)[k];
      if (is_apart(a, b, Vec2(-side[1], side[0]), gap)) return true;
      if (set->size() == 2 && is_apart(a, b, side, gap)) return true;
    }
  }
  return false;
}

bool share_corner(const FeatureCorners& a, const FeatureCorners& b) {
  return std::ranges::any_of(
      a.view(), [&](std::int32_t corner) { return std::ranges::find(b.view(), corner) != b.view().end(); });
}

}  // namespace

MinimiserSet::MinimiserSet(const Scene& scene, const RigidTransform& X_WM, const Lmd& lmd, double tolerance)
    : point_(lmd.point_moving), direction_(lmd.direction) {
  static const RigidTransform identity;
  const Surface& moving = scene.moving->surface();
  const Surface& fixed = scene.fixed[static_cast<std::size_t>(lmd.fixed_body)]->surface();
  const double coordinates =
      std::max(lmd.point_moving.cwiseAbs().maxCoeff(), lmd.point_fixed.cwiseAbs().maxCoeff());
  gap_ = tolerance + TOUCHING_SETS * coordinates;
  const double reach = tolerance + 64.0 * std::numeric_limits<double>::epsilon() * coordinates +
                       PLATEAU_TOLERANCE * lmd.distance;
  const auto corners = [](const Surface& surface, std::int32_t triangle) {
    return FeatureCorners(surface, {FeatureKind::FACE, triangle});
  };
  parts_.push_back(
      {{point_}, FeatureCorners(moving, lmd.feature_moving), FeatureCorners(fixed, lmd.feature_fixed)});
  const PlanarFrame frame(point_, direction_);
  const std::vector<InContact> of_moving =
      in_contact(moving, X_WM, lmd.feature_moving, lmd.point_moving, frame, direction_, reach, gap_);
  if (of_moving.empty()) return;
  const std::vector<InContact> of_fixed =
      in_contact(fixed, identity, lmd.feature_fixed, lmd.point_fixed, frame, direction_, reach, gap_);
  for (const InContact& a : of_moving) {
    for (const InContact& b : of_fixed) {
      std::vector<Vec3> shape;
      for (const Vec2& corner : a.shape.cut_by(b.shape).corners) shape.push_back(frame.lifted(corner));
      if (!shape.empty())
        parts_.push_back({std::move(shape), corners(moving, a.triangle), corners(fixed, b.triangle)});
    }
  }
}

bool MinimiserSet::touches(const MinimiserSet& other) const {
  const PlanarFrame frame(point_, direction_);
  const auto flat = [&](const std::vector<Vec3>& shape) {
    std::vector<Vec2> result;
    for (const Vec3& x : shape) result.push_back(frame.flat(x));
    return result;
  };
  const double gap = std::max(gap_, other.gap_);
  for (const Part& a : parts_)
    for (const Part& b : other.parts_)
      if (share_corner(a.on_moving, b.on_moving) && share_corner(a.on_fixed, b.on_fixed) &&
          !is_apart(flat(a.shape), flat(b.shape), gap))
        return true;
  return false;
}

}  // namespace lmdbench
