// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/decision/contact_places.h>
#include <lmdbench/geometry/segment_distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lmdbench {

namespace {

/// Sine of the largest angle between planes of one contact that rounding explains.
constexpr double LARGEST_TURN = 1e-3;
/// Polygons of more pieces get a grid of them.
constexpr std::size_t PIECES_WITHOUT_GRID = 8;

}  // namespace

Eigen::AlignedBox3d ContactPlaces::box_of(const Contact& contact, double within) const {
  Eigen::AlignedBox3d box;
  if (contact.dimension == 0) {
    box.extend(contact.point_fixed);
  } else if (contact.dimension == 1) {
    for (const Vec3& end : contact.ends_fixed) box.extend(end);
  } else {
    const PlanarFrame& frame = set_.frames[contact.frame];
    const Vec3 n = frame.u.cross(frame.v), lift = n.dot(contact.point_fixed - frame.origin) * n;
    for (const ConvexPolygon& piece : set_.pieces_of(contact))
      for (const Vec2& corner : piece.corners) box.extend(Vec3(frame.lifted(corner) + lift));
  }
  const Vec3 margin = Vec3::Constant(within);
  return {box.min() - margin, box.max() + margin};
}

Vec3 ContactPlaces::nearest_place(const Contact& contact, const Vec3& q) const {
  if (contact.dimension == 0) return contact.point_fixed;
  if (contact.dimension == 1)
    return point_segment_distance(q, {contact.ends_fixed[0], contact.ends_fixed[1]}).point;
  const PlanarFrame& frame = set_.frames[contact.frame];
  const Vec2 x = frame.flat(q);
  Vec2 nearest = x;
  double least = std::numeric_limits<double>::infinity();
  for (const ConvexPolygon& polygon : set_.pieces_of(contact)) {
    if (polygon.holds(x, 0.0)) return q;
    const Vec2 on_side = polygon.nearest_on_sides(x);
    if (const double distance = (on_side - x).norm(); distance < least) {
      least = distance;
      nearest = on_side;
    }
  }
  return q + frame.lifted(nearest) - frame.lifted(x);
}

double ContactPlaces::granted(const Contact& a, const Contact& b, double way) const {
  const int extended = (a.dimension > 0) + (b.dimension > 0);
  return (1.0 + extended) * tolerance_.known + tolerance_.rounding + fall_of_farther(a, b, way);
}

double ContactPlaces::fall_of_farther(const Contact& a, const Contact& b, double way) const {
  return (a.distance < b.distance ? b : a).fall * way;
}

bool ContactPlaces::have_one_direction(const Contact& a, const Contact& b, double way) const {
  const double apart = (a.direction - b.direction).norm(), farther = std::max(a.distance, b.distance);
  // Points of a convex set whose distances to the origin differ by f are within sqrt(4 length f).
  const double rounded = 8.0 * tolerance_.rounding / std::max(farther, tolerance_.rounding);
  if (apart <= 2.0 * tolerance_.largest_tilt + a.direction_error + b.direction_error +
                   std::min(std::sqrt(rounded), LARGEST_TURN))
    return true;
  const double fall = fall_of_farther(a, b, way);
  return fall > tolerance_.rounding &&
         (a.distance * a.direction - b.distance * b.direction).squaredNorm() <= 4.0 * farther * fall;
}

/// Whether `fits` holds for a piece of a polygon near a box.
template <class Fits>
bool ContactPlaces::any_piece_near(const Contact& contact, const Box2& box, double within, Fits&& fits) {
  const auto pieces = set_.pieces_of(contact);
  if (pieces.size() <= PIECES_WITHOUT_GRID) return std::ranges::any_of(pieces, fits);
  // Each corner and chain of a large contact asks.
  if (grids_.size() < set_.frames.size()) grids_.resize(set_.frames.size());
  std::optional<BoxGrid>& grid = grids_[contact.frame];
  if (!grid) {
    std::vector<Box2> boxes;
    for (const ConvexPolygon& piece : pieces) boxes.push_back(piece.box());
    grid.emplace(boxes);
  }
  return !grid->for_each_near(box, within,
                              [&](std::int32_t i) { return !fits(pieces[static_cast<std::size_t>(i)]); });
}

bool ContactPlaces::meet(const Contact& a, const Contact& b) {
  if (a.dimension < b.dimension) return meet(b, a);
  const double within = tolerance_.known;
  if (a.dimension == 0)
    return (a.point_moving - b.point_moving).norm() <= within &&
           (a.point_fixed - b.point_fixed).norm() <= within;
  if (a.dimension == 1) {
    const auto are_near = [&](const std::array<Vec3, 2>& own, const std::array<Vec3, 2>& ends,
                              const Vec3& point) {
      const Segment segment{own[0], own[1]};
      return b.dimension == 0
                 ? (point_segment_distance(point, segment).point - point).norm() <= within
                 : segment_distance(segment, {ends[0], ends[1]}).squared_distance <= within * within;
    };
    return are_near(a.ends_moving, b.ends_moving, b.point_moving) &&
           are_near(a.ends_fixed, b.ends_fixed, b.point_fixed);
  }
  const PlanarFrame& frame = set_.frames[a.frame];
  const auto touches = [&](const ConvexPolygon& other) {
    return any_piece_near(a, other.box(), within,
                          [&](const ConvexPolygon& piece) { return piece.touches(other, within); });
  };
  const auto holds = [&](const Vec2& x) {
    Box2 box;
    box.add(x);
    return any_piece_near(a, box, within, [&](const ConvexPolygon& piece) { return piece.holds(x, within); });
  };
  const auto meets = [&](const Vec3& point, const std::array<Vec3, 2>& ends, const Vec2& shift) {
    if (b.dimension == 0) return holds(frame.flat(point));
    if (b.dimension == 1) {
      const Vec2 begin = frame.flat(ends[0]), end = frame.flat(ends[1]);
      return holds(begin) || touches(ConvexPolygon({begin, end}));
    }
    const PlanarFrame& other = set_.frames[b.frame];
    return std::ranges::any_of(set_.pieces_of(b), [&](ConvexPolygon piece) {
      for (Vec2& corner : piece.corners) corner = frame.flat(other.lifted(corner)) + shift;
      return touches(piece);
    });
  };
  // Both sides of `a` lie over each other along its normal; those of `b` are shifted by `apart`.
  const Vec2 apart = frame.flat(b.point_moving) - frame.flat(b.point_fixed);
  return meets(b.point_fixed, b.ends_fixed, Vec2::Zero()) &&
         (apart.norm() <= within || meets(b.point_moving, b.ends_moving, apart));
}

}  // namespace lmdbench
