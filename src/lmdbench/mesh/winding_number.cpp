// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/winding_number.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace lmdbench {
namespace {

/// Signed solid angle of a triangle seen from a point [sr].
double solid_angle(const Vec3& point, const Triangle& triangle) {
  const Vec3 a = triangle[0] - point;
  const Vec3 b = triangle[1] - point;
  const Vec3 c = triangle[2] - point;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

double winding_number(const Vec3& point, const TriangleMesh& mesh) {
  double angle = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    angle += solid_angle(point, mesh.triangle(static_cast<std::int32_t>(t)));
  return angle / (4.0 * std::numbers::pi);
}

double winding_number(const Vec3& point, const TriangleMesh& mesh, std::span<const std::int32_t> triangles) {
  double angle = 0.0;
  for (const std::int32_t t : triangles) angle += solid_angle(point, mesh.triangle(t));
  return angle / (4.0 * std::numbers::pi);
}

}  // namespace lmdbench
