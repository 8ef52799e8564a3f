// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lmdbench_method.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

/// Shared, in doubles: meshes, closest points (Ericson, Real-Time Collision Detection, 5.1).
namespace rivals {

using Point = std::array<double, 3>;

inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator*(double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double distance(const Point& a, const Point& b) {
  return std::sqrt(dot(b - a, b - a));
}

inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Point& a) {
  return std::sqrt(dot(a, a));
}

/// Force on A and its torque about a point.
struct Wrench {
  Point about{}, force{}, torque{};
  void push(const Point& at, const Point& by) {
    force = force + by;
    torque = torque + cross(at - about, by);
  }
  void to(double* wrench) const {
    std::copy(force.begin(), force.end(), wrench);
    std::copy(torque.begin(), torque.end(), wrench + 3);
  }
};

/// (R | t) of lmdbench_method.h.
struct Transform {
  const double* X;
  Point operator()(const Point& p) const {
    Point q{};
    for (std::size_t r = 0; r < 3; ++r)
      q[r] = X[4 * r] * p[0] + X[4 * r + 1] * p[1] + X[4 * r + 2] * p[2] + X[4 * r + 3];
    return q;
  }
  Point origin() const { return {X[3], X[7], X[11]}; }
  /// R^T (p - t)
  Point inverse(const Point& p) const {
    const Point d{p[0] - X[3], p[1] - X[7], p[2] - X[11]};
    Point q{};
    for (std::size_t c = 0; c < 3; ++c) q[c] = X[c] * d[0] + X[4 + c] * d[1] + X[8 + c] * d[2];
    return q;
  }
};

struct Mesh {
  std::vector<Point> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  /// For each vertex a triangle and its corner there; -1 for a vertex of no triangle.
  std::vector<std::int32_t> triangle_of, corner_of;
  double diagonal = 0.0;

  explicit Mesh(const lmdbench_mesh& from) {
    Point low{}, high{};
    for (std::uint64_t v = 0; v < from.vertex_count; ++v) {
      vertices.push_back({from.vertices[3 * v], from.vertices[3 * v + 1], from.vertices[3 * v + 2]});
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = v == 0 ? vertices[v][k] : std::min(low[k], vertices[v][k]);
        high[k] = v == 0 ? vertices[v][k] : std::max(high[k], vertices[v][k]);
      }
    }
    diagonal = distance(low, high);
    triangle_of.assign(vertices.size(), -1);
    corner_of.assign(vertices.size(), 0);
    for (std::uint64_t t = 0; t < from.triangle_count; ++t) {
      triangles.push_back({from.triangles[3 * t], from.triangles[3 * t + 1], from.triangles[3 * t + 2]});
      for (std::int32_t k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(triangles[t][static_cast<std::size_t>(k)]);
        if (triangle_of[v] >= 0) continue;
        triangle_of[v] = static_cast<std::int32_t>(t);
        corner_of[v] = k;
      }
    }
  }
  const Point& corner(std::size_t triangle, std::size_t k) const {
    return vertices[static_cast<std::size_t>(triangles[triangle][k])];
  }
};

inline Point closest_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Point bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
  const Point cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  const double scale = 1.0 / (va + vb + vc);
  return a + (vb * scale) * ab + (vc * scale) * ac;
}

/// Closest points of the segments p1 q1 and p2 q2.
inline void closest_of_segments(const Point& p1, const Point& q1, const Point& p2, const Point& q2,
                                Point& on_1, Point& on_2) {
  const Point d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
  const double a = dot(d1, d1), e = dot(d2, d2), f = dot(d2, r);
  double s = 0.0, t = 0.0;
  if (a > 0 && e > 0) {
    const double c = dot(d1, r), b = dot(d1, d2), denominator = a * e - b * b;
    if (denominator > 1e-14 * a * e) s = std::clamp((b * f - c * e) / denominator, 0.0, 1.0);
    t = (b * s + f) / e;
    if (t < 0 || t > 1) {
      t = std::clamp(t, 0.0, 1.0);
      s = std::clamp((b * t - c) / a, 0.0, 1.0);
    }
  } else if (e > 0) {
    t = std::clamp(f / e, 0.0, 1.0);
  } else if (a > 0) {
    s = std::clamp(-dot(d1, r) / a, 0.0, 1.0);
  }
  on_1 = p1 + s * d1;
  on_2 = p2 + t * d2;
}

using Corners = std::array<Point, 3>;

/// Closest points of two triangles that do not intersect.
inline void closest_of_triangles(const Corners& a, const Corners& b, Point& on_a, Point& on_b) {
  double best = INFINITY;
  const auto offer = [&](const Point& p, const Point& q) {
    if (const double d = distance(p, q); d < best) best = d, on_a = p, on_b = q;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    offer(a[i], closest_on_triangle(a[i], b[0], b[1], b[2]));
    offer(closest_on_triangle(b[i], a[0], a[1], a[2]), b[i]);
    for (std::size_t j = 0; j < 3; ++j) {
      Point p{}, q{};
      closest_of_segments(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3], p, q);
      offer(p, q);
    }
  }
}

/// A contact with its distance, for sorting.
struct Found {
  double distance;
  lmdbench_contact contact;
};

inline Found found(const Point& a, const Point& b, std::int32_t triangle_a, std::int32_t part_a,
                   std::int32_t triangle_b, std::int32_t part_b) {
  return {distance(a, b), {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, triangle_a, triangle_b, part_a, part_b}};
}

/// Nearest first; the order does not depend on threads or hashes.
inline void hand_over(std::vector<Found>& all, std::vector<lmdbench_contact>& contacts) {
  std::sort(all.begin(), all.end(), [](const Found& x, const Found& y) {
    const lmdbench_contact &a = x.contact, &b = y.contact;
    if (x.distance != y.distance) return x.distance < y.distance;
    if (a.triangle_a != b.triangle_a) return a.triangle_a < b.triangle_a;
    if (a.triangle_b != b.triangle_b) return a.triangle_b < b.triangle_b;
    return a.part_a != b.part_a ? a.part_a < b.part_a : a.part_b < b.part_b;
  });
  for (const Found& one : all) contacts.push_back(one.contact);
}

}  // namespace rivals
