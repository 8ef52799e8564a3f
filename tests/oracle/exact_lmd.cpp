// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "oracle/exact_lmd.h"

#include <CGAL/Gmpq.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace lmdbench::testing {
namespace {

using Number = CGAL::Gmpq;

struct Point {
  Number x, y, z;
};

Point exact(const Vec3& p) {
  return {Number(p[0]), Number(p[1]), Number(p[2])};
}
Point operator-(const Point& a, const Point& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Point operator+(const Point& a, const Point& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Point operator*(const Number& s, const Point& a) {
  return {s * a.x, s * a.y, s * a.z};
}
Number dot(const Point& a, const Point& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
bool is_inside(const Number& t) {
  return t > 0 && t < 1;
}

/// Cosine below which the outer side of a direction is in doubt. The pseudo-normals are rounded to 1e-16.
constexpr double CLEAR_COSINE = 1e-9;

/// One mesh in the world.
struct Side {
  const Surface& surface;
  RigidTransform transform;
  std::vector<Vec3> vertices;
  std::vector<Point> exact_vertices;

  Side(const Surface& mesh, const Pose& pose) : surface(mesh), transform(pose) {
    for (const Vec3& vertex : surface.mesh.vertices) {
      vertices.push_back(transform.point(vertex));
      exact_vertices.push_back(exact(vertices.back()));
    }
  }

  /// Vertex numbers of a feature: one, two or three.
  std::vector<std::int32_t> corners(const FeatureId& feature) const {
    const auto index = static_cast<std::size_t>(feature.index);
    switch (feature.kind) {
      case FeatureKind::VERTEX:
        return {feature.index};
      case FeatureKind::EDGE: {
        const auto& edge = surface.adjacency.edges[index];
        return {edge[0], edge[1]};
      }
      case FeatureKind::FACE:
        break;
    }
    const auto& face = surface.mesh.triangles[index];
    return {face[0], face[1], face[2]};
  }

  std::vector<Point> exact_corners(const FeatureId& feature) const {
    std::vector<Point> result;
    for (const std::int32_t corner : corners(feature)) {
      result.push_back(exact_vertices[static_cast<std::size_t>(corner)]);
    }
    return result;
  }

  Eigen::AlignedBox3d box(const FeatureId& feature) const {
    Eigen::AlignedBox3d result;
    for (const std::int32_t corner : corners(feature))
      result.extend(vertices[static_cast<std::size_t>(corner)]);
    return result;
  }

  std::vector<FeatureId> features() const {
    std::vector<FeatureId> result;
    const auto add = [&result](FeatureKind kind, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i) result.push_back({kind, static_cast<std::int32_t>(i)});
    };
    add(FeatureKind::VERTEX, vertices.size());
    add(FeatureKind::EDGE, surface.adjacency.edges.size());
    add(FeatureKind::FACE, surface.mesh.triangles.size());
    return result;
  }

  /// No corner around the feature is nearer to first order: d . (x - p) <= 0.
  bool is_first_order_minimum(const FeatureId& feature, const Point& p, const Point& d) const {
    for (const std::int32_t triangle : surface.incident_triangles(feature)) {
      for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(triangle)]) {
        if (dot(d, exact_vertices[static_cast<std::size_t>(corner)] - p) > 0) return false;
      }
    }
    return true;
  }

  /// Cosine between d and the feature's pseudo-normal.
  double outwardness(const FeatureId& feature, const Vec3& d) const {
    return d.normalized().dot(transform.direction(surface.pseudo_normal(feature)));
  }
};

struct Feet {
  Point p, q;
};

/// Foot of x strictly inside the segment ab.
std::optional<Point> foot_on_edge(const Point& x, const std::vector<Point>& edge) {
  const Point e = edge[1] - edge[0];
  const Number squared_length = dot(e, e);
  if (squared_length == 0) return std::nullopt;
  const Number t = dot(x - edge[0], e) / squared_length;
  if (!is_inside(t)) return std::nullopt;
  return edge[0] + t * e;
}

std::optional<Point> foot_on_face(const Point& x, const std::vector<Point>& face) {
  const Point n = cross(face[1] - face[0], face[2] - face[0]);
  const Number squared_n = dot(n, n);
  if (squared_n == 0) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k) {
    if (dot(cross(face[(k + 1) % 3] - face[k], x - face[k]), n) <= 0) return std::nullopt;
  }
  return x - dot(x - face[0], n) / squared_n * n;
}

/// Feet of the common perpendicular of two lines; empty where they are parallel, which counts as undecided.
std::optional<Feet> feet_of_lines(const std::vector<Point>& a, const std::vector<Point>& b, bool& parallel) {
  const Point u = a[1] - a[0], v = b[1] - b[0], w = b[0] - a[0];
  const Number uu = dot(u, u), vv = dot(v, v), uv = dot(u, v);
  const Number determinant = uu * vv - uv * uv;
  parallel = determinant == 0;
  if (parallel) return std::nullopt;
  const Number s = (dot(w, u) * vv - dot(w, v) * uv) / determinant;
  const Number t = (dot(w, u) * uv - dot(w, v) * uu) / determinant;
  if (!is_inside(s) || !is_inside(t)) return std::nullopt;
  return Feet{a[0] + s * u, b[0] + t * v};
}

std::optional<Feet> feet(const std::vector<Point>& a, const std::vector<Point>& b, bool& parallel) {
  parallel = false;
  if (a.size() == 1 && b.size() == 1) return Feet{a[0], b[0]};
  if (a.size() == 2 && b.size() == 2) return feet_of_lines(a, b, parallel);
  const bool a_is_point = a.size() == 1;
  const Point& x = a_is_point ? a[0] : b[0];
  const std::vector<Point>& other = a_is_point ? b : a;
  const auto foot = other.size() == 2 ? foot_on_edge(x, other) : foot_on_face(x, other);
  if (!foot) return std::nullopt;
  return a_is_point ? Feet{x, *foot} : Feet{*foot, x};
}

}  // namespace

ExactLmdSet exact_lmds(const Surface& moving, const Pose& X_WM, const Surface& fixed, double cutoff) {
  const Side a(moving, X_WM);
  const Side b(fixed, Pose());
  const Number squared_cutoff = Number(cutoff) * Number(cutoff);
  // Boxes only spare work; the slack keeps their rounding from deciding anything.
  const double reach = cutoff * (1.0 + 1e-9);
  ExactLmdSet result;
  const std::vector<FeatureId> features_b = b.features();
  for (const FeatureId& feature_a : a.features()) {
    const auto corners_a = a.exact_corners(feature_a);
    const Eigen::AlignedBox3d box_a = a.box(feature_a);
    for (const FeatureId& feature_b : features_b) {
      const auto corner_count = a.corners(feature_a).size() + b.corners(feature_b).size();
      const bool one_is_vertex =
          feature_a.kind == FeatureKind::VERTEX || feature_b.kind == FeatureKind::VERTEX;
      if (corner_count > 4 || (corner_count == 4 && !one_is_vertex && feature_a.kind != feature_b.kind))
        continue;
      if (box_a.exteriorDistance(b.box(feature_b)) > reach) continue;
      bool parallel = false;
      const auto pair = feet(corners_a, b.exact_corners(feature_b), parallel);
      result.undecided += parallel;
      if (!pair) continue;
      const Point d = pair->q - pair->p;
      const Number squared_distance = dot(d, d);
      if (squared_distance == 0 || squared_distance > squared_cutoff) continue;
      if (!a.is_first_order_minimum(feature_a, pair->p, d)) continue;
      if (!b.is_first_order_minimum(feature_b, pair->q, Number(-1) * d)) continue;
      const Vec3 direction(CGAL::to_double(d.x), CGAL::to_double(d.y), CGAL::to_double(d.z));
      const double out_a = a.outwardness(feature_a, direction);
      const double out_b = b.outwardness(feature_b, -direction);
      if (std::min(std::abs(out_a), std::abs(out_b)) < CLEAR_COSINE) {
        ++result.undecided;
      } else if (out_a > 0.0 && out_b > 0.0) {
        result.lmds.push_back({feature_a, feature_b, std::sqrt(CGAL::to_double(squared_distance))});
      }
    }
  }
  std::sort(result.lmds.begin(), result.lmds.end());
  return result;
}

}  // namespace lmdbench::testing
