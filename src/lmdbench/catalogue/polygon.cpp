// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/polygon.h>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace lmdbench {
namespace {

using Point = Eigen::Vector2d;
using Corners = std::array<std::size_t, 3>;

/// Of a triangle that counts as not turned over, in areas of the polygon.
constexpr double ROUNDING = -1e-6;

/// How far a corner may be from a side that it counts as on, in the largest coordinate: some
/// roundings of single precision.
constexpr double ON_SIDE = 5e-7;

/// Twice the area of a triangle, above 0 where it turns to the left.
double area_of(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The triangles of the first corner's fan that all pass.
std::vector<Corners> fan(std::size_t count, const auto& passes) {
  std::vector<Corners> triangles;
  for (std::size_t first = 0; first < count; ++first) {
    triangles.clear();
    for (std::size_t k = 1; k + 1 < count; ++k) {
      const Corners corners{first, (first + k) % count, (first + k + 1) % count};
      if (!passes(corners)) break;
      triangles.push_back(corners);
    }
    if (triangles.size() == count - 2) return triangles;
  }
  return {};
}

/// The polygon along its largest coordinate axis, turning to the left.
std::vector<Point> flattened(const std::vector<Vec3>& at, const Vec3& area) {
  int axis = 0;
  area.cwiseAbs().maxCoeff(&axis);
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (area[axis] < 0.0) std::swap(u, v);
  std::vector<Point> flat;
  flat.reserve(at.size());
  for (const Vec3& p : at) flat.emplace_back(p[u], p[v]);
  return flat;
}

/// Whether a triangle turns to the left and none of its corners is on the side between the others.
bool is_full(const Point& a, const Point& b, const Point& c, double on_side) {
  const double longest =
      std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  return area_of(a, b, c) > on_side * longest;
}

/// Ear clipping: a corner whose triangle turns to the left and holds no other corner is cut off.
/// What is along a side is left for a triangle that has an area: two faces that cut off the corner
/// between the same two sides would give an edge four triangles. Empty where sides cross.
std::vector<Corners> ears(const std::vector<Point>& at, double on_side) {
  std::vector<std::size_t> left(at.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  double whole = 0.0;
  for (std::size_t k = 1; k + 1 < at.size(); ++k) whole += area_of(at[0], at[k], at[k + 1]);
  std::vector<Corners> triangles;
  const auto corners_at = [&](std::size_t k) {
    return Corners{left[(k + left.size() - 1) % left.size()], left[k], left[(k + 1) % left.size()]};
  };
  // A corner at the place of one of the three is the other end of a slit or of a bridge to a hole.
  const auto holds_a_corner = [&](const Corners& ear, double slack) {
    const Point &a = at[ear[0]], &b = at[ear[1]], &c = at[ear[2]];
    const auto is_within = [slack](const Point& from, const Point& to, const Point& p) {
      return area_of(from, to, p) >= -slack * (to - from).norm();
    };
    return std::ranges::any_of(left, [&](std::size_t other) {
      const Point& p = at[other];
      return p != a && p != b && p != c && is_within(a, b, p) && is_within(b, c, p) && is_within(c, a, p);
    });
  };
  const auto full = [&](const Corners& ear) { return is_full(at[ear[0]], at[ear[1]], at[ear[2]], on_side); };
  const auto above = [&](double least) {
    return [&, least](const Corners& ear) { return area_of(at[ear[0]], at[ear[1]], at[ear[2]]) > least; };
  };
  std::size_t next = 0;  // goes round, so that no corner is the hub of a fan of slivers
  const auto cut = [&](const auto& passes, double slack) {
    for (std::size_t tried = 0; tried < left.size(); ++tried) {
      const std::size_t step = (tried + 1) / 2;  // to both sides: the next ear is often near
      const std::size_t k = (next + (tried % 2 == 1 ? left.size() - step : step)) % left.size();
      const Corners ear = corners_at(k);
      if (!passes(ear) || holds_a_corner(ear, slack)) continue;
      triangles.push_back(ear);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
      next = k + 1;
      return true;
    }
    return false;
  };
  while (left.size() > 3)
    if (!cut(full, on_side) && !cut(above(0.0), 0.0) && !cut(above(ROUNDING * whole), 0.0)) return {};
  const Corners last = corners_at(1);
  if (area_of(at[last[0]], at[last[1]], at[last[2]]) < ROUNDING * whole) return {};
  triangles.push_back(last);
  return triangles;
}

}  // namespace

std::optional<PolygonFault> add_polygon(std::span<const std::int32_t> polygon, TriangleMesh& mesh) {
  const auto count = static_cast<std::int64_t>(polygon.size());
  if (count > limit_of(Limit::POLYGON_CORNERS))
    return PolygonFault{
        fmt::format("a polygon of {} corners, above the limit of {}", count,
                    limit_of(Limit::POLYGON_CORNERS)),
        "cut it into triangles where it was made, or " + raise_remedy(Limit::POLYGON_CORNERS)};
  if (std::ssize(mesh.triangles) + count - 2 > limit_of(Limit::TRIANGLES))
    return PolygonFault{fmt::format("more triangles than the limit of {}", limit_of(Limit::TRIANGLES)),
                        "decimate the mesh, or " + raise_remedy(Limit::TRIANGLES)};
  if (count == 3) {
    mesh.triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return std::nullopt;
  }
  const auto place_of = [&](std::int32_t vertex) { return mesh.vertices[static_cast<std::size_t>(vertex)]; };
  std::vector<std::int32_t> corners;  // without those at the place of the one before
  for (const std::int32_t vertex : polygon)
    if (corners.empty() || place_of(vertex) != place_of(corners.back())) corners.push_back(vertex);
  while (corners.size() > 1 && place_of(corners.back()) == place_of(corners.front())) corners.pop_back();
  if (corners.size() < 3) return std::nullopt;

  std::vector<Vec3> at;
  at.reserve(corners.size());
  for (const std::int32_t vertex : corners) at.push_back(place_of(vertex));
  Vec3 area = Vec3::Zero();
  double coordinates = 0.0;
  for (std::size_t k = 1; k + 1 < at.size(); ++k) area += (at[k] - at[0]).cross(at[k + 1] - at[0]);
  for (const Vec3& p : at) coordinates = std::max(coordinates, p.lpNorm<Eigen::Infinity>());
  const std::vector<Point> flat = flattened(at, area);
  const double on_side = ON_SIDE * coordinates;
  std::vector<Corners> triangles =
      fan(at.size(), [&](const Corners& t) { return is_full(flat[t[0]], flat[t[1]], flat[t[2]], on_side); });
  if (triangles.empty()) triangles = ears(flat, on_side);
  if (triangles.empty())
    triangles = fan(at.size(), [&](const Corners& t) {
      return (at[t[1]] - at[t[0]]).cross(at[t[2]] - at[t[0]]).dot(area) >= ROUNDING * area.squaredNorm();
    });
  const bool folds = area.isZero(0.0) && std::ranges::any_of(triangles, [&](const Corners& t) {
                       return !(at[t[1]] - at[t[0]]).cross(at[t[2]] - at[t[0]]).isZero(0.0);
                     });
  if (triangles.empty() || folds)
    return PolygonFault{"a polygon whose sides cross or touch, or that bends too far",
                        "cut it into triangles where it was made"};
  for (const auto& [a, b, c] : triangles) mesh.triangles.push_back({corners[a], corners[b], corners[c]});
  return std::nullopt;
}

}  // namespace lmdbench
