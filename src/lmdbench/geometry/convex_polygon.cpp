// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/geometry/extent.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace lmdbench {

ConvexPolygon::ConvexPolygon(const PlanarFrame& frame, const Triangle& triangle)
    : corners{frame.flat(triangle[0]), frame.flat(triangle[1]), frame.flat(triangle[2])} {
  if (cross(corners[1] - corners[0], corners[2] - corners[0]) < 0.0) std::swap(corners[1], corners[2]);
}

ConvexPolygon ConvexPolygon::cut_by(const ConvexPolygon& other) const {
  std::vector<Vec2> kept = corners, cut;
  for (std::size_t k = 0; k < other.corners.size() && !kept.empty(); ++k) {
    const Vec2& p = other.corners[k];
    const Vec2 side = other.corners[(k + 1) % other.corners.size()] - p;
    cut.clear();
    double side_from = cross(side, kept.front() - p);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const Vec2& from = kept[i];
      const Vec2& to = kept[(i + 1) % kept.size()];
      const double side_to = cross(side, to - p);
      if (side_from >= 0.0) cut.push_back(from);
      if ((side_from > 0.0 && side_to < 0.0) || (side_from < 0.0 && side_to > 0.0))
        cut.push_back(from + side_from / (side_from - side_to) * (to - from));
      side_from = side_to;
    }
    kept.swap(cut);
  }
  return ConvexPolygon(std::move(kept));
}

SegmentPart ConvexPolygon::part_of(const Vec2& p, const Vec2& q, double within) const {
  SegmentPart part{0.0, corners.empty() ? 0.0 : 1.0};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 side = corners[(k + 1) % corners.size()] - corners[k];
    const double spare = within > 0.0 ? within * side.norm() : 0.0;
    const double side_p = cross(side, p - corners[k]) + spare, side_q = cross(side, q - corners[k]) + spare;
    if (side_p < 0.0 && side_q < 0.0) return {};
    if (side_p < 0.0) part.begin = std::max(part.begin, side_p / (side_p - side_q));
    if (side_q < 0.0) part.end = std::min(part.end, side_p / (side_p - side_q));
  }
  if (within > 0.0 && part.begin < part.end) {
    // Beyond the tip of a needle along the segment both sides' lines are within reach for long.
    const Vec2 along = q - p;
    const Extent extent = extent_along(corners, along);
    const double spare = 2.0 * within * along.norm(), start = along.dot(p), squared = along.squaredNorm();
    part.begin = std::max(part.begin, (extent.least - spare - start) / squared);
    part.end = std::min(part.end, (extent.greatest + spare - start) / squared);
  }
  return part;
}

Box2 ConvexPolygon::box() const {
  Box2 box;
  for (const Vec2& corner : corners) box.add(corner);
  return box;
}

Vec2 ConvexPolygon::nearest_on_sides(const Vec2& x) const {
  LMDBENCH_EXPECTS(!corners.empty(), "a polygon of nothing");
  Vec2 nearest = corners.front();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 &from = corners[k], side = corners[(k + 1) % corners.size()] - from;
    const double squared = side.squaredNorm();
    const double share = squared > 0.0 ? std::clamp((x - from).dot(side) / squared, 0.0, 1.0) : 0.0;
    const Vec2 on_side = from + share * side;
    if (const double distance = (on_side - x).norm(); distance < least) {
      least = distance;
      nearest = on_side;
    }
  }
  return nearest;
}

namespace {

/// How far a side of `a` keeps all of b away at least: the most over the sides, or the first above
/// `within`; 0 where none does.
double kept_away(const ConvexPolygon& a, std::span<const Vec2> b, double within) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.corners.size() && most <= within; ++k) {
    const Vec2 side = a.corners[(k + 1) % a.corners.size()] - a.corners[k];
    double nearest = -std::numeric_limits<double>::infinity();
    for (const Vec2& x : b)
      if ((nearest = std::max(nearest, cross(side, x - a.corners[k]))) >= 0.0) break;
    if (nearest < 0.0) most = std::max(most, -nearest / side.norm());
  }
  return most;
}

/// Whether a point is no farther than `within` from some side.
bool is_beside(const ConvexPolygon& polygon, const Vec2& x, double within) {
  return (polygon.nearest_on_sides(x) - x).norm() <= within;
}

}  // namespace

bool ConvexPolygon::holds(const Vec2& x, double within) const {
  LMDBENCH_EXPECTS(within >= 0.0, "a tolerance that is negative or not a number");
  if (corners.empty()) return false;
  const double away = kept_away(*this, {&x, 1}, within);
  // Beyond a sharp corner a point is farther off than its sides tell.
  return away == 0.0 || (away <= within && is_beside(*this, x, within));
}

bool ConvexPolygon::touches(const ConvexPolygon& other, double within) const {
  LMDBENCH_EXPECTS(within >= 0.0, "a tolerance that is negative or not a number");
  double away = kept_away(*this, other.corners, within);
  if (away <= within) away = std::max(away, kept_away(other, corners, within));
  if (away == 0.0 || away > within) return away == 0.0;
  const auto is_near = [&](const ConvexPolygon& a, const ConvexPolygon& b) {
    return std::ranges::any_of(b.corners, [&](const Vec2& x) { return is_beside(a, x, within); });
  };
  return is_near(*this, other) || is_near(other, *this);
}

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  const auto append = [&](const Vec2& x, std::size_t least) {
    while (hull.size() > least && cross(hull.back() - hull[hull.size() - 2], x - hull.back()) <= 0.0)
      hull.pop_back();
    hull.push_back(x);
  };
  for (const Vec2& x : points) append(x, 1);
  const std::size_t lower = hull.size();
  for (auto x = points.rbegin() + 1; x != points.rend(); ++x) append(*x, lower);
  hull.pop_back();
  return hull;
}

double width_of(std::span<const Vec2> hull) {
  if (hull.size() < 3) return 0.0;
  const auto next = [&](std::size_t k) { return k + 1 < hull.size() ? k + 1 : 0; };
  double width = std::numeric_limits<double>::infinity();
  // The corner farthest from a side advances with the side (Shamos 1978).
  std::size_t farthest = 1;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vec2 side = (hull[next(k)] - hull[k]).normalized();
    if (farthest == k) farthest = next(k);
    while (next(farthest) != k && cross(side, hull[next(farthest)] - hull[farthest]) > 0.0)
      farthest = next(farthest);
    width = std::min(width, std::max(0.0, cross(side, hull[farthest] - hull[k])));
  }
  return width;
}

const Vec2& farthest_along(std::span<const Vec2> hull, const Vec2& axis) {
  LMDBENCH_EXPECTS(!hull.empty(), "a hull of nothing");
  const auto corner = [&](std::size_t k) -> const Vec2& { return hull[k < hull.size() ? k : 0]; };
  const auto first_without = [](std::size_t begin, std::size_t end, auto&& has) {
    while (begin < end)
      if (const std::size_t middle = begin + (end - begin) / 2; has(middle))
        begin = middle + 1;
      else
        end = middle;
    return begin;
  };
  // The sides turn by less than 180 degrees from the first corner to the rightmost, and again on
  // the way back. On the chain towards the axis, corners first rise along it, then fall.
  const std::size_t right = first_without(0, hull.size() - 1, [&](std::size_t k) {
    const Vec2 side = corner(k + 1) - corner(k);
    return side[0] > 0.0 || (side[0] == 0.0 && side[1] > 0.0);
  });
  const auto rises = [&](std::size_t k) { return axis.dot(corner(k + 1) - corner(k)) > 0.0; };
  return axis[1] <= 0.0 ? corner(first_without(0, right, rises))
                        : corner(first_without(right, hull.size(), rises));
}

AreaAndCentroid area_and_centroid(std::span<const Vec2> corners) {
  AreaAndCentroid result;
  if (corners.size() < 3) return result;
  // A fan from the first corner keeps the products as small as the polygon.
  const Vec2& origin = corners[0];
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec2 a = corners[i] - origin, b = corners[i + 1] - origin;
    const double area = 0.5 * cross(a, b);
    result.area += area;
    result.centroid += area / 3.0 * (a + b);
  }
  if (result.area > 0.0) result.centroid = origin + result.centroid / result.area;
  return result;
}

}  // namespace lmdbench
