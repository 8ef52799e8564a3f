// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CGAL/Simple_cartesian.h>
#include <judge/exact_scene_body.h>

#include <array>
#include <cstdint>
#include <optional>

namespace lmdbench::exact {

/// The LMD condition of two features in a number type. Exact numbers decide it; intervals reject
/// most pairs at 1 % of the cost and throw CGAL::Uncertain_conversion_exception if they cannot.
template <typename Number>
class LmdCondition {
 public:
  using Kernel = CGAL::Simple_cartesian<Number>;
  using Point = typename Kernel::Point_3;
  using Vector = typename Kernel::Vector_3;
  struct Pair {
    Point p, q;
  };

  LmdCondition(const WorldBody& moving, const WorldBody& fixed, double cutoff)
      : moving_(moving), fixed_(fixed), cutoff_(cutoff) {}

  /// The critical pair of points inside both features that meets the first-order condition, if its
  /// distance is above 0 and within the cutoff. The outer side of vertices is not tested.
  std::optional<Pair> operator()(const FeatureId& on_moving, const FeatureId& on_fixed) const {
    std::optional<Pair> pair = critical(on_moving, on_fixed);
    if (!pair) return std::nullopt;
    const Vector d = pair->q - pair->p;
    const Number squared = d.squared_length();
    if (squared > Number(cutoff_) * Number(cutoff_) || squared == 0) return std::nullopt;
    if (!admits(moving_, on_moving, pair->p, d) || !admits(fixed_, on_fixed, pair->q, -d))
      return std::nullopt;
    return pair;
  }

 private:
  static Point point(const Vec3& p) { return {p[0], p[1], p[2]}; }

  std::optional<Pair> critical(const FeatureId& on_moving, const FeatureId& on_fixed) const {
    const auto swapped = [](std::optional<Pair> pair) {
      if (pair) std::swap(pair->p, pair->q);
      return pair;
    };
    if (on_moving.kind > on_fixed.kind) return swapped(critical(fixed_, on_fixed, moving_, on_moving));
    return critical(moving_, on_moving, fixed_, on_fixed);
  }

  /// @pre kinds ascend from a to b; neither face-face nor edge-face
  static std::optional<Pair> critical(const WorldBody& a, const FeatureId& on_a, const WorldBody& b,
                                      const FeatureId& on_b) {
    const auto ends = [](const WorldBody& body, std::int32_t edge) {
      return std::array{point(body.vertex(body.ends(edge)[0])), point(body.vertex(body.ends(edge)[1]))};
    };
    if (on_a.kind == FeatureKind::EDGE) return edge_edge(ends(a, on_a.index), ends(b, on_b.index));
    const Point v = point(a.vertex(on_a.index));
    if (on_b.kind == FeatureKind::VERTEX) return Pair{v, point(b.vertex(on_b.index))};
    if (on_b.kind == FeatureKind::EDGE) return vertex_edge(v, ends(b, on_b.index));
    const Triangle t = b.triangle(on_b.index);
    return vertex_face(v, {point(t[0]), point(t[1]), point(t[2])});
  }

  static std::optional<Pair> vertex_edge(const Point& v, const std::array<Point, 2>& e) {
    const Vector u = e[1] - e[0];
    const Number along = (v - e[0]) * u, whole = u.squared_length();
    if (!(along > 0 && along < whole)) return std::nullopt;
    return Pair{v, e[0] + u * (along / whole)};
  }

  static std::optional<Pair> vertex_face(const Point& v, const std::array<Point, 3>& t) {
    const Vector n = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
    for (std::size_t i = 0; i < 3; ++i)
      if (!(n * CGAL::cross_product(t[(i + 1) % 3] - t[i], v - t[i]) > 0)) return std::nullopt;
    return Pair{v, v - n * ((v - t[0]) * n / n.squared_length())};
  }

  static std::optional<Pair> edge_edge(const std::array<Point, 2>& e, const std::array<Point, 2>& f) {
    const Vector u = e[1] - e[0], v = f[1] - f[0], w = f[0] - e[0];
    const Vector n = CGAL::cross_product(u, v);
    const Number whole = n.squared_length();
    const Number s = CGAL::cross_product(w, v) * n;
    if (!(s > 0 && s < whole)) return std::nullopt;
    const Number t = CGAL::cross_product(w, u) * n;
    if (!(t > 0 && t < whole)) return std::nullopt;
    return Pair{e[0] + u * (s / whole), f[0] + v * (t / whole)};
  }

  /// No corner of incident triangles is nearer, and d is on the outer side of faces and edges.
  static bool admits(const WorldBody& body, const FeatureId& feature, const Point& p, const Vector& d) {
    if (feature.kind != FeatureKind::FACE) {
      for (const std::int32_t triangle : body.surface().incident_triangles(feature))
        for (const std::int32_t corner : body.corners(triangle)) {
          // A critical pair's d is perpendicular to the feature: its own corners are never nearer.
          if (is_corner_of(body, feature, corner)) continue;
          if (d * (point(body.vertex(corner)) - p) > 0) return false;
        }
    }
    if (!body.has_side(feature)) return true;
    switch (feature.kind) {
      case FeatureKind::FACE:
        return d * normal(body, feature.index) > 0;
      case FeatureKind::EDGE:
        return on_outer_side_of_edge(body, feature.index, d);
      case FeatureKind::VERTEX:
        break;
    }
    return true;
  }

  static bool is_corner_of(const WorldBody& body, const FeatureId& feature, std::int32_t corner) {
    if (feature.kind == FeatureKind::VERTEX) return corner == feature.index;
    const auto& ends = body.ends(feature.index);
    return corner == ends[0] || corner == ends[1];
  }

  static Vector normal(const WorldBody& body, std::int32_t triangle) {
    const Triangle t = body.triangle(triangle);
    const Point a = point(t[0]);
    return CGAL::cross_product(point(t[1]) - a, point(t[2]) - a);
  }

  /// Sign of d . (n1 / |n1| + n2 / |n2|), by comparing squares instead of taking roots.
  static bool on_outer_side_of_edge(const WorldBody& body, std::int32_t edge, const Vector& d) {
    Number positive = 0, negative = 0;  // squared terms of either sign, at most two in all
    for (const std::int32_t triangle : body.surface().adjacency.edge_triangles[edge]) {
      const Vector n = normal(body, triangle);
      const Number squared_length = n.squared_length();
      if (squared_length == 0) continue;
      const Number product = d * n;
      const Number squared = product * product / squared_length;
      if (product > 0) positive += squared;
      if (product < 0) negative += squared;
    }
    return positive > negative;
  }

  const WorldBody& moving_;
  const WorldBody& fixed_;
  double cutoff_;
};

}  // namespace lmdbench::exact
