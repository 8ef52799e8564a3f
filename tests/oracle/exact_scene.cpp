// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "oracle/exact_scene.h"

#include "oracle/exact_distance.h"
#include "oracle/feature_boxes.h"
#include <CGAL/Gmpq.h>
#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace lmdbench::exact {
namespace {

using testing::exact_distance;
using testing::feature_boxes;
using testing::for_each_near;

using Number = CGAL::Lazy_exact_nt<CGAL::Gmpq>;
using Kernel = CGAL::Simple_cartesian<Number>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;

constexpr double EPSILON = std::numeric_limits<double>::epsilon();
/// Roundings that a distance or a difference of points may carry in double precision, in epsilons of the
/// largest coordinate.
constexpr double ROUNDINGS = 64.0;
/// Sine below which an outer side or the area of a triangle is left to rounding.
constexpr double UNCERTAIN_SINE = 1e-9;

Vec3 rounded(const Point& p) {
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

/// One mesh of the scene in the world, in exact numbers.
class ExactBody {
 public:
  ExactBody(const Surface& surface, const RigidTransform& X_WS) : surface_(surface) {
    for (const Vec3& vertex : surface.mesh.vertices) {
      vertices_W_.push_back(X_WS.point(vertex));
      const Vec3& p = vertices_W_.back();
      points_.emplace_back(p[0], p[1], p[2]);
    }
  }

  const Surface& surface() const { return surface_; }
  const std::vector<Vec3>& vertices_W() const { return vertices_W_; }
  const Point& point(std::int32_t vertex) const { return points_[static_cast<std::size_t>(vertex)]; }
  const auto& edge(std::int32_t index) const {
    return surface_.adjacency.edges[static_cast<std::size_t>(index)];
  }
  const auto& corners(std::int32_t triangle) const {
    return surface_.mesh.triangles[static_cast<std::size_t>(triangle)];
  }
  Vector normal(std::int32_t triangle) const {
    const auto& [a, b, c] = corners(triangle);
    return CGAL::cross_product(point(b) - point(a), point(c) - point(a));
  }

  /// The first-order condition: no corner of the incident triangles is nearer, and the outer side.
  /// @param certain is made false where the outcome hangs on rounding
  bool admits(const FeatureId& feature, const Point& p, const Vector& d, bool& certain) const {
    if (feature.kind != FeatureKind::FACE) {
      for (const std::int32_t triangle : surface_.incident_triangles(feature))
        for (const std::int32_t corner : corners(triangle))
          if (d * (point(corner) - p) > 0) return false;
    }
    // Of a triangle without area several features share each point: which of them carries it is open.
    for (const std::int32_t triangle : surface_.incident_triangles(feature))
      if (nearly_flat(triangle)) certain = false;
    return !has_side(feature) || on_outer_side(feature, d, certain);
  }

 private:
  bool has_side(const FeatureId& feature) const {
    if (feature.kind == FeatureKind::FACE) return true;
    if (surface_.is_boundary(feature)) return false;
    if (feature.kind == FeatureKind::EDGE)
      return !surface_.edge_is_non_manifold[static_cast<std::size_t>(feature.index)];
    const auto edges = surface_.adjacency.vertex_edges[feature.index];
    return std::none_of(edges.begin(), edges.end(), [&](std::int32_t e) {
      return surface_.edge_is_non_manifold[static_cast<std::size_t>(e)];
    });
  }

  bool on_outer_side(const FeatureId& feature, const Vector& d, bool& certain) const {
    switch (feature.kind) {
      case FeatureKind::FACE:
        return d * normal(feature.index) > 0;
      case FeatureKind::EDGE:
        return on_outer_side_of_edge(feature.index, d);
      case FeatureKind::VERTEX:
        break;
    }
    return on_outer_side_of_vertex(feature.index, d, certain);
  }

  /// Sign of d . (n1 / |n1| + n2 / |n2|), by comparing squares instead of taking roots.
  bool on_outer_side_of_edge(std::int32_t edge_index, const Vector& d) const {
    Number positive = 0, negative = 0;  // squares of the terms of either sign, two terms at most
    for (const std::int32_t triangle : surface_.adjacency.edge_triangles[edge_index]) {
      const Vector n = normal(triangle);
      const Number squared_length = n.squared_length();
      if (squared_length == 0) continue;
      const Number product = d * n;
      const Number squared = product * product / squared_length;
      if (product > 0) positive += squared;
      if (product < 0) negative += squared;
    }
    return positive > negative;
  }

  bool on_outer_side_of_vertex(std::int32_t vertex, const Vector& d, bool& certain) const {
    using Wide = std::array<long double, 3>;
    const auto wide = [](const Vec3& v) { return Wide{v[0], v[1], v[2]}; };
    const auto minus = [](const Wide& a, const Wide& b) {
      return Wide{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    };
    const auto dot = [](const Wide& a, const Wide& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const auto cross = [](const Wide& a, const Wide& b) {
      return Wide{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto length = [&](const Wide& a) { return std::sqrt(dot(a, a)); };
    const Wide direction{CGAL::to_double(d.x()), CGAL::to_double(d.y()), CGAL::to_double(d.z())};
    long double sum = 0.0L, weights = 0.0L;
    for (const std::int32_t triangle : surface_.adjacency.vertex_triangles[vertex]) {
      if (normal(triangle).squared_length() == 0) continue;
      auto order = corners(triangle);
      while (order[0] != vertex) std::rotate(order.begin(), order.begin() + 1, order.end());
      const Wide p = wide(vertices_W_[static_cast<std::size_t>(vertex)]);
      const Wide u = minus(wide(vertices_W_[static_cast<std::size_t>(order[1])]), p);
      const Wide v = minus(wide(vertices_W_[static_cast<std::size_t>(order[2])]), p);
      const Wide n = cross(u, v);
      const long double doubled_area = length(n);
      if (doubled_area == 0.0L) continue;
      const long double angle = std::atan2(doubled_area, dot(u, v));
      sum += angle * dot(n, direction) / doubled_area;
      weights += angle;
    }
    if (!(std::abs(sum) > static_cast<long double>(UNCERTAIN_SINE) * weights * length(direction)))
      certain = false;
    return sum > 0.0L;
  }

  bool nearly_flat(std::int32_t triangle) const {
    const auto& [a, b, c] = corners(triangle);
    const auto at = [&](std::int32_t i) { return vertices_W_[static_cast<std::size_t>(i)]; };
    const Vec3 u = at(b) - at(a), v = at(c) - at(a);
    const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
    return !(u.cross(v).norm() > UNCERTAIN_SINE * longest);
  }

  const Surface& surface_;
  std::vector<Vec3> vertices_W_;
  std::vector<Point> points_;
};

struct Critical {
  Point p, q;
};

std::optional<Critical> vertex_edge(const Point& v, const Point& a, const Point& b) {
  const Vector u = b - a;
  const Number along = (v - a) * u, whole = u.squared_length();
  if (!(along > 0 && along < whole)) return std::nullopt;
  return Critical{v, a + u * (along / whole)};
}

std::optional<Critical> vertex_face(const Point& v, const std::array<Point, 3>& t) {
  const Vector n = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  for (std::size_t i = 0; i < 3; ++i)
    if (!(n * CGAL::cross_product(t[(i + 1) % 3] - t[i], v - t[i]) > 0)) return std::nullopt;
  return Critical{v, v - n * ((v - t[0]) * n / n.squared_length())};
}

std::optional<Critical> edge_edge(const Point& a, const Point& b, const Point& c, const Point& e) {
  const Vector u = b - a, v = e - c, w = c - a;
  const Vector n = CGAL::cross_product(u, v);
  const Number whole = n.squared_length();
  const Number s = CGAL::cross_product(w, v) * n, t = CGAL::cross_product(w, u) * n;
  if (!(s > 0 && s < whole && t > 0 && t < whole)) return std::nullopt;
  return Critical{a + u * (s / whole), c + v * (t / whole)};
}

/// Collects the exact LMDs of the moving and one fixed body.
class Search {
 public:
  Search(const ExactBody& moving, const ExactBody& fixed, std::int32_t body, double cutoff,
         std::vector<ExactLmd>& result)
      : moving_(moving), fixed_(fixed), body_(body), cutoff_(cutoff), result_(result) {}

  void run() {
    using enum FeatureKind;
    for (const auto& [a, b] : {std::pair(VERTEX, VERTEX), std::pair(VERTEX, EDGE), std::pair(EDGE, VERTEX),
                               std::pair(VERTEX, FACE), std::pair(FACE, VERTEX), std::pair(EDGE, EDGE)}) {
      for_each_near(feature_boxes(moving_.surface(), moving_.vertices_W(), a),
                    feature_boxes(fixed_.surface(), fixed_.vertices_W(), b), cutoff_,
                    [&, kind_a = a, kind_b = b](std::int32_t i, std::int32_t j) {
                      judge({kind_a, i}, {kind_b, j});
                    });
    }
  }

 private:
  std::optional<Critical> critical(const FeatureId& on_moving, const FeatureId& on_fixed) const {
    const auto ends = [](const ExactBody& body, std::int32_t edge) {
      return std::pair(body.point(body.edge(edge)[0]), body.point(body.edge(edge)[1]));
    };
    const auto face = [](const ExactBody& body, std::int32_t triangle) {
      const auto& [a, b, c] = body.corners(triangle);
      return std::array{body.point(a), body.point(b), body.point(c)};
    };
    const auto swapped = [](std::optional<Critical> pair) {
      if (pair) std::swap(pair->p, pair->q);
      return pair;
    };
    const std::int32_t i = on_moving.index, j = on_fixed.index;
    if (on_moving.kind == FeatureKind::VERTEX) {
      if (on_fixed.kind == FeatureKind::VERTEX) return Critical{moving_.point(i), fixed_.point(j)};
      if (on_fixed.kind == FeatureKind::FACE) return vertex_face(moving_.point(i), face(fixed_, j));
      const auto [a, b] = ends(fixed_, j);
      return vertex_edge(moving_.point(i), a, b);
    }
    if (on_moving.kind == FeatureKind::FACE) return swapped(vertex_face(fixed_.point(j), face(moving_, i)));
    const auto [a, b] = ends(moving_, i);
    if (on_fixed.kind == FeatureKind::VERTEX) return swapped(vertex_edge(fixed_.point(j), a, b));
    const auto [c, e] = ends(fixed_, j);
    return edge_edge(a, b, c, e);
  }

  void judge(const FeatureId& on_moving, const FeatureId& on_fixed) {
    const std::optional<Critical> pair = critical(on_moving, on_fixed);
    if (!pair) return;
    const Vector d = pair->q - pair->p;
    const Number squared = d.squared_length();
    if (squared == 0 || squared > Number(cutoff_) * Number(cutoff_)) return;
    bool certain = true;
    if (!moving_.admits(on_moving, pair->p, d, certain)) return;
    if (!fixed_.admits(on_fixed, pair->q, -d, certain)) return;
    ExactLmd lmd{on_moving, on_fixed, body_, 0.0, rounded(pair->p), rounded(pair->q), certain};
    lmd.distance = std::sqrt(CGAL::to_double(squared));
    const double rounding =
        ROUNDINGS * EPSILON *
        std::max(lmd.point_moving.cwiseAbs().maxCoeff(), lmd.point_fixed.cwiseAbs().maxCoeff());
    if (lmd.distance <= rounding || cutoff_ - lmd.distance <= rounding) lmd.certain = false;
    result_.push_back(lmd);
  }

  const ExactBody& moving_;
  const ExactBody& fixed_;
  std::int32_t body_;
  double cutoff_;
  std::vector<ExactLmd>& result_;
};

bool same_features(const Lmd& found, const ExactLmd& exact) {
  return found.fixed_body == exact.fixed_body && found.feature_moving == exact.feature_moving &&
         found.feature_fixed == exact.feature_fixed;
}

/// The plateau's own tolerance (lmd/plateau.h): equal distance vectors, here also in one plane of contact.
bool same_contact(const Lmd& found, const ExactLmd& exact) {
  constexpr double PLATEAU = 1e-9;
  if (found.fixed_body != exact.fixed_body) return false;
  const Vec3 apart = found.point_moving - exact.point_moving;
  const double coordinates =
      std::max(exact.point_moving.cwiseAbs().maxCoeff(), exact.point_fixed.cwiseAbs().maxCoeff());
  const double rounding = ROUNDINGS * EPSILON * coordinates;
  const Vec3 d = exact.point_fixed - exact.point_moving;
  const Vec3 difference = found.point_fixed - found.point_moving - d;
  const double allowed = PLATEAU * exact.distance + rounding;
  const double tilt = allowed / exact.distance;  // of the two planes of contact
  return difference.norm() <= allowed &&
         std::abs(apart.dot(d)) <= exact.distance * (rounding + tilt * apart.norm());
}

}  // namespace

std::vector<ExactLmd> exact_lmds(const Scene& scene, const Pose& X_WM) {
  const ExactBody moving(scene.moving->surface(), RigidTransform(X_WM));
  std::vector<ExactLmd> result;
  for (std::size_t i = 0; i < scene.fixed.size(); ++i) {
    const ExactBody fixed(scene.fixed[i]->surface(), RigidTransform());
    Search(moving, fixed, static_cast<std::int32_t>(i), scene.cutoff, result).run();
  }
  return result;
}

ExactAgreement compare_with_exact(const LmdSet& found, const std::vector<ExactLmd>& exact) {
  ExactAgreement agreement;
  for (const ExactLmd& truth : exact) {
    ++agreement.exact;
    if (std::any_of(found.begin(), found.end(), [&](const Lmd& lmd) { return same_features(lmd, truth); })) {
      ++agreement.same_features;
    } else if (std::any_of(found.begin(), found.end(),
                           [&](const Lmd& lmd) { return same_contact(lmd, truth); })) {
      ++agreement.same_contact;
    } else if (!truth.certain) {
      ++agreement.uncertain;
    } else {
      agreement.missed.push_back(truth);
    }
  }
  for (const Lmd& lmd : found) {
    if (lmd.intersecting || lmd.distance == 0.0) continue;
    ++agreement.found;
    if (std::none_of(exact.begin(), exact.end(), [&](const ExactLmd& truth) {
          return same_features(lmd, truth) || same_contact(lmd, truth);
        }))
      agreement.untrue.push_back(lmd);
  }
  return agreement;
}

bool within_tolerance(const Scene& scene, const Pose& X_WM, const Lmd& lmd) {
  constexpr double SINE = 1e-9;
  const auto admits = [](const ExactBody& body, const FeatureId& feature, const Vec3& p_W, const Vec3& d_W) {
    const double rounding = ROUNDINGS * EPSILON * (p_W.cwiseAbs().maxCoeff() + d_W.norm());
    for (const std::int32_t triangle : body.surface().incident_triangles(feature)) {
      for (const std::int32_t corner : body.corners(triangle)) {
        const Vec3 to_corner = body.vertices_W()[static_cast<std::size_t>(corner)] - p_W;
        if (!(d_W.dot(to_corner) <= (SINE * d_W.norm() + rounding) * to_corner.norm())) return false;
      }
    }
    return true;
  };
  const ExactBody moving(scene.moving->surface(), RigidTransform(X_WM));
  const ExactBody fixed(scene.fixed[static_cast<std::size_t>(lmd.fixed_body)]->surface(), RigidTransform());
  const Vec3 d_W = lmd.point_fixed - lmd.point_moving;
  return admits(moving, lmd.feature_moving, lmd.point_moving, d_W) &&
         admits(fixed, lmd.feature_fixed, lmd.point_fixed, -d_W);
}

bool exactly_touching(const Scene& scene, const Pose& X_WM) {
  const RigidTransform transform(X_WM);
  const Surface& moving = scene.moving->surface();
  std::vector<Vec3> vertices_W;
  for (const Vec3& vertex : moving.mesh.vertices) vertices_W.push_back(transform.point(vertex));
  const auto boxes = feature_boxes(moving, vertices_W, FeatureKind::FACE);
  bool touching = false;
  for (const auto& body : scene.fixed) {
    const Surface& fixed = body->surface();
    for_each_near(boxes, feature_boxes(fixed, fixed.mesh.vertices, FeatureKind::FACE), 0.0,
                  [&](std::int32_t i, std::int32_t j) {
                    touching = touching || exact_distance(transform.triangle(moving.mesh.triangle(i)),
                                                          fixed.mesh.triangle(j)) == 0.0;
                  });
  }
  return touching;
}

std::string describe(const ExactLmd& lmd) {
  std::ostringstream text;
  text.precision(17);
  text << to_string(lmd.feature_moving.kind) << " " << lmd.feature_moving.index << " of the moving mesh, "
       << to_string(lmd.feature_fixed.kind) << " " << lmd.feature_fixed.index << " of fixed mesh "
       << lmd.fixed_body << ", distance " << lmd.distance << ", at " << lmd.point_moving.transpose()
       << " and " << lmd.point_fixed.transpose();
  return text.str();
}

}  // namespace lmdbench::exact
