// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/polygon.h>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

namespace lmdbench {
namespace {

using Point = Eigen::Vector2d;
using Corners = std::array<std::size_t, 3>;

/// Of a triangle that counts as not turned over, in areas of the polygon.
constexpr double ROUNDING = -1e-6;

/// Twice the area of a triangle, above 0 where it turns to the left.
double area_of(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The triangles of the first corner's fan in which none is turned over.
/// @param least  of a triangle that counts as not turned over, in areas of the polygon
std::vector<Corners> fan(const std::vector<Vec3>& at, const Vec3& area, double least) {
  const std::size_t count = at.size();
  std::vector<Corners> triangles;
  for (std::size_t first = 0; first < count; ++first) {
    triangles.clear();
    for (std::size_t k = 1; k + 1 < count; ++k) {
      const Corners corners{first, (first + k) % count, (first + k + 1) % count};
      if ((at[corners[1]] - at[first]).cross(at[corners[2]] - at[first]).dot(area) <
          least * area.squaredNorm())
        break;
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

/// Ear clipping: a corner whose triangle turns to the left and holds no other corner is cut off. A
/// corner along a side is left for a triangle that has an area. Empty where sides cross.
std::vector<Corners> ears(const std::vector<Point>& at) {
  std::vector<std::size_t> left(at.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  double whole = 0.0;
  for (std::size_t k = 1; k + 1 < at.size(); ++k) whole += area_of(at[0], at[k], at[k + 1]);
  std::vector<Corners> triangles;
  const auto corners_at = [&](std::size_t k) {
    return Corners{left[(k + left.size() - 1) % left.size()], left[k], left[(k + 1) % left.size()]};
  };
  // A corner at the place of one of the three is the other end of a slit or of a bridge to a hole.
  const auto holds_a_corner = [&](const Corners& ear, bool also_on_sides) {
    const Point &a = at[ear[0]], &b = at[ear[1]], &c = at[ear[2]];
    return std::ranges::any_of(left, [&](std::size_t other) {
      const Point& p = at[other];
      if (p == a || p == b || p == c) return false;
      const double least = std::min({area_of(a, b, p), area_of(b, c, p), area_of(c, a, p)});
      return least > 0.0 || (also_on_sides && least == 0.0);
    });
  };
  std::size_t next = 0;  // goes round, so that no corner is the hub of a fan of slivers
  const auto cut = [&](double above, bool also_on_sides) {
    for (std::size_t tried = 0; tried < left.size(); ++tried) {
      const std::size_t step = (tried + 1) / 2;  // to both sides: the next ear is often near
      const std::size_t k = (next + (tried % 2 == 1 ? left.size() - step : step)) % left.size();
      const Corners ear = corners_at(k);
      if (!(area_of(at[ear[0]], at[ear[1]], at[ear[2]]) > above) || holds_a_corner(ear, also_on_sides))
        continue;
      triangles.push_back(ear);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
      next = k + 1;
      return true;
    }
    return false;
  };
  while (left.size() > 3)
    if (!cut(0.0, true) && !cut(0.0, false) && !cut(ROUNDING * whole, false)) return {};
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
  std::vector<Vec3> at;
  at.reserve(polygon.size());
  for (const std::int32_t vertex : polygon) at.push_back(mesh.vertices[static_cast<std::size_t>(vertex)]);
  Vec3 area = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < at.size(); ++k) area += (at[k] - at[0]).cross(at[k + 1] - at[0]);
  // A notch may have less than rounding of the area.
  std::vector<Corners> triangles = fan(at, area, 0.0);
  if (triangles.empty()) triangles = ears(flattened(at, area));
  if (triangles.empty()) triangles = fan(at, area, ROUNDING);
  const bool folds = area.isZero(0.0) && std::ranges::any_of(triangles, [&](const Corners& t) {
                       return !(at[t[1]] - at[t[0]]).cross(at[t[2]] - at[t[0]]).isZero(0.0);
                     });
  if (triangles.empty() || folds)
    return PolygonFault{"a polygon whose sides cross or touch, or that bends too far",
                        "cut it into triangles where it was made"};
  for (const auto& [a, b, c] : triangles) mesh.triangles.push_back({polygon[a], polygon[b], polygon[c]});
  return std::nullopt;
}

}  // namespace lmdbench
