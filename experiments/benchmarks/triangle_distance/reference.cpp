// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <benchmarks/triangle_distance/reference.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lmdbench::experiments {
namespace {

constexpr std::size_t CORNERS = 9;

double segment_norm(const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double squared_length = ab.squaredNorm();
  if (squared_length == 0.0) return a.norm();
  return (a + std::clamp(-a.dot(ab) / squared_length, 0.0, 1.0) * ab).norm();
}

/// Distance of the origin from the inside of a triangle; infinite when its foot lies
/// outside, where an edge is nearer.
double face_norm(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double squared_norm = normal.squaredNorm();
  if (squared_norm == 0.0) return INFINITY;
  // Barycentric coordinates of the origin's foot, times the squared norm.
  const double weight_a = b.cross(c).dot(normal);
  const double weight_b = c.cross(a).dot(normal);
  const double weight_c = a.cross(b).dot(normal);
  if (weight_a < 0.0 || weight_b < 0.0 || weight_c < 0.0) return INFINITY;
  return std::abs(a.dot(normal)) / std::sqrt(squared_norm);
}

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

bool tetrahedron_holds_origin(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 o = Vec3::Zero();
  const std::array<double, 4> parts = {volume(o, b, c, d), volume(a, o, c, d), volume(a, b, o, d),
                                       volume(a, b, c, o)};
  return std::all_of(parts.begin(), parts.end(), [](double v) { return v > 0.0; }) ||
         std::all_of(parts.begin(), parts.end(), [](double v) { return v < 0.0; });
}

}  // namespace

double reference_triangle_distance(const Triangle& a, const Triangle& b) {
  std::array<Vec3, CORNERS> p;
  for (std::size_t i = 0; i < CORNERS; ++i) p[i] = a[i / 3] - b[i % 3];
  double least = INFINITY;
  for (std::size_t i = 0; i < CORNERS; ++i)
    for (std::size_t j = i + 1; j < CORNERS; ++j) {
      least = std::min(least, segment_norm(p[i], p[j]));
      for (std::size_t k = j + 1; k < CORNERS; ++k) {
        least = std::min(least, face_norm(p[i], p[j], p[k]));
        for (std::size_t l = k + 1; l < CORNERS; ++l)
          if (tetrahedron_holds_origin(p[i], p[j], p[k], p[l])) return 0.0;
      }
    }
  return least;
}

}  // namespace lmdbench::experiments
