// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/triangle_normal.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace lmdbench {

namespace {

// a * b - c * d with one rounding error of the result's size (Kahan): a plain difference of products loses
// every digit on needles, whose normals are then noise although their corners are exact.
double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  const double error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + error;
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
  // A power of two: scaling changes no digit.
  const int exponent = std::ilogb(largest);
  double longest_squared = 0.0;
  for (Vec3& side : sides) {
    for (int i = 0; i < 3; ++i) side[i] = std::scalbn(side[i], -exponent);
    longest_squared = std::max(longest_squared, side.squaredNorm());
  }
  const Vec3 cross = accurate_cross(sides[0], sides[1]);
  const double length = cross.norm();
  if (length <= ZERO_AREA_TOLERANCE * longest_squared) return Vec3::Zero();
  return cross / length;
}

double corner_angle(const Triangle& triangle, int corner) {
  const auto c = static_cast<std::size_t>(corner);
  const Vec3 to_next = (triangle[(c + 1) % 3] - triangle[c]).stableNormalized();
  const Vec3 to_previous = (triangle[(c + 2) % 3] - triangle[c]).stableNormalized();
  if (to_next.isZero(0.0) || to_previous.isZero(0.0)) return 0.0;
  return std::atan2(to_next.cross(to_previous).norm(), to_next.dot(to_previous));
}

}  // namespace lmdbench
