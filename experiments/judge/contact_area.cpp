// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <judge/contact_area.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace lmdbench::exact {
namespace {

using Number = CGAL::Gmpq;
using Kernel = CGAL::Simple_cartesian<Number>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Flat = Kernel::Point_2;

Point exact(const Vec3& p) {
  return {Number(p[0]), Number(p[1]), Number(p[2])};
}

struct Face {
  Point first;
  Vector normal;
};

Face face_of(const Triangle& t) {
  const Point a = exact(t[0]);
  return {a, CGAL::cross_product(exact(t[1]) - a, exact(t[2]) - a)};
}

/// Twice the area of a triangle, positive where it runs counter-clockwise.
Number turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

using Polygon = std::vector<Flat>;

/// The part of a convex polygon to the left of a line.
Polygon left_of(const Polygon& polygon, const Flat& from, const Flat& to) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Flat &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Number at_p = turn(from, to, p), at_q = turn(from, to, q);
    if (at_p >= 0) result.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      const Number part = at_p / (at_p - at_q);
      result.emplace_back(p.x() + part * (q.x() - p.x()), p.y() + part * (q.y() - p.y()));
    }
  }
  return result;
}

/// A triangle projected along an axis, counter-clockwise.
Polygon seen_along(std::size_t axis, const Triangle& t, const Vector& shift) {
  Polygon result;
  for (const Vec3& corner : t) {
    const Point p = exact(corner) + shift;
    const std::array<Number, 3> x = {p.x(), p.y(), p.z()};
    result.emplace_back(x[(axis + 1) % 3], x[(axis + 2) % 3]);
  }
  if (turn(result[0], result[1], result[2]) < 0) std::swap(result[1], result[2]);
  return result;
}

std::size_t largest_axis(const Vec3& n) {
  Eigen::Index axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  return static_cast<std::size_t>(axis);
}

bool is_triangles(const CellPairs& pairs, std::size_t pair) {
  return pairs.dimension(pair) == 4;
}

/// Perpendicular vector from the plane of b to that of a.
Vector between_planes(const Face& a, const Face& b) {
  return a.normal * (((a.first - b.first) * a.normal) / a.normal.squared_length());
}

double rounded(const Number& x) {
  return CGAL::to_double(x);
}

}  // namespace

bool exactly_facing(const CellPairs& pairs, std::size_t pair) {
  if (!is_triangles(pairs, pair)) return false;
  const Vec3 rough_a = pairs.a().normal(pairs[pair].a), rough_b = pairs.b().normal(pairs[pair].b);
  if (!(rough_a.cross(rough_b).norm() < 1e-12 * rough_a.norm() * rough_b.norm() &&
        rough_a.dot(rough_b) < 0.0))
    return false;
  const Face a = face_of(pairs.a().triangle(pairs[pair].a)), b = face_of(pairs.b().triangle(pairs[pair].b));
  return CGAL::cross_product(a.normal, b.normal) == CGAL::NULL_VECTOR && a.normal * (b.first - a.first) > 0;
}

ContactArea contact_area(const CellPairs& pairs, std::span<const std::size_t> which) {
  ContactArea result;
  double moment_u = 0.0, moment_v = 0.0;
  std::size_t axis = 0;
  Vec3 normal = Vec3::Zero(), on_a = Vec3::Zero(), to_b = Vec3::Zero();
  for (const std::size_t i : which) {
    if (!is_triangles(pairs, i)) continue;
    const Triangle a = pairs.a().triangle(pairs[i].a), b = pairs.b().triangle(pairs[i].b);
    if (!exactly_facing(pairs, i)) {
      const Vec3 n = pairs.a().normal(pairs[i].a).normalized(), m = pairs.b().normal(pairs[i].b).normalized();
      result.nearly = result.nearly || (n.dot(m) < 0.0 && n.cross(m).norm() < 1e-6);
      continue;
    }
    const Face face_a = face_of(a), face_b = face_of(b);
    const Vector shift = between_planes(face_a, face_b);
    if (result.area == 0.0) axis = largest_axis(pairs.a().normal(pairs[i].a));
    Polygon overlap = seen_along(axis, a, CGAL::NULL_VECTOR);
    const Polygon other = seen_along(axis, b, shift);
    for (std::size_t side = 0; side < 3; ++side)
      overlap = left_of(overlap, other[side], other[(side + 1) % 3]);
    Number doubled = 0, sum_u = 0, sum_v = 0;
    for (std::size_t k = 1; k + 1 < overlap.size(); ++k) {
      const Number part = turn(overlap[0], overlap[k], overlap[k + 1]);
      doubled += part;
      sum_u += part * (overlap[0].x() + overlap[k].x() + overlap[k + 1].x());
      sum_v += part * (overlap[0].y() + overlap[k].y() + overlap[k + 1].y());
    }
    if (doubled == 0) continue;
    if (result.area == 0.0) {
      normal = pairs.a().normal(pairs[i].a).normalized();
      on_a = a[0];
      to_b = -Vec3(rounded(shift.x()), rounded(shift.y()), rounded(shift.z()));
    }
    result.area += 0.5 * rounded(doubled);
    moment_u += rounded(sum_u) / 6.0;
    moment_v += rounded(sum_v) / 6.0;
  }
  if (result.area == 0.0) return result;
  const auto k = static_cast<Eigen::Index>(axis), u = (k + 1) % 3, v = (k + 2) % 3;
  Vec3 centroid;
  centroid[u] = moment_u / result.area;
  centroid[v] = moment_v / result.area;
  centroid[k] =
      on_a[k] - (normal[u] * (centroid[u] - on_a[u]) + normal[v] * (centroid[v] - on_a[v])) / normal[k];
  result.area /= std::abs(normal[k]);
  result.centroid_a = centroid;
  result.centroid_b = centroid + to_b;
  return result;
}

}  // namespace lmdbench::exact
