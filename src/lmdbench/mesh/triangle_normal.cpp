// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/triangle_normal.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace lmdbench {

namespace {

// a * b - c * d with one rounding error of the result's size (Kahan). A plain difference loses
// every digit on needles, whose normals are then noise although their corners are exact.
double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  const double error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + error;
}

/// Between unit vectors or zeros.
double angle_between(const Vec3& to_next, const Vec3& from_previous) {
  if (to_next.isZero(0.0) || from_previous.isZero(0.0)) return 0.0;
  return std::atan2(to_next.cross(from_previous).norm(), -to_next.dot(from_previous));
}

}  // namespace

Vec3 accurate_cross(const Vec3& a, const Vec3& b) {
  return {difference_of_products(a.y(), b.z(), a.z(), b.y()),
          difference_of_products(a.z(), b.x(), a.x(), b.z()),
          difference_of_products(a.x(), b.y(), a.y(), b.x())};
}

Vec3 triangle_normal(const Triangle& triangle) {
  std::array<Vec3, 3> sides;
  double largest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    sides[k] = triangle[(k + 1) % 3] - triangle[k];
    largest = std::max(largest, sides[k].cwiseAbs().maxCoeff());
  }
  if (!(largest > 0.0)) return Vec3::Zero();
  // Powers of two change no digit. In two steps, because the inverse of a subnormal is no number.
  const double half_scale = std::scalbn(1.0, -std::ilogb(largest) / 2);
  const double rest = std::scalbn(1.0, -std::ilogb(largest * half_scale));
  double longest_squared = 0.0;
  for (Vec3& side : sides) {
    side = rest * (half_scale * side);
    longest_squared = std::max(longest_squared, side.squaredNorm());
  }
  const Vec3 cross = accurate_cross(sides[0], sides[1]);
  const double length = cross.norm();
  if (length <= ZERO_AREA_TOLERANCE * longest_squared) return Vec3::Zero();
  return cross / length;
}

std::array<double, 3> corner_angles(const Triangle& triangle) {
  std::array<Vec3, 3> sides;
  for (std::size_t k = 0; k < 3; ++k) sides[k] = (triangle[(k + 1) % 3] - triangle[k]).stableNormalized();
  std::array<double, 3> angles{};
  for (std::size_t k = 0; k < 3; ++k) angles[k] = angle_between(sides[k], sides[(k + 2) % 3]);
  return angles;
}

double corner_angle(const Triangle& triangle, std::size_t corner) {
  const std::size_t next = (corner + 1) % 3, previous = (corner + 2) % 3;
  return angle_between((triangle[next] - triangle[corner]).stableNormalized(),
                       (triangle[corner] - triangle[previous]).stableNormalized());
}

}  // namespace lmdbench
