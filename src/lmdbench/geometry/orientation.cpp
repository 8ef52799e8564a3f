// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/expansion.h>
#include <lmdbench/geometry/orientation.h>

#include <array>
#include <cmath>
#include <limits>

namespace lmdbench {
namespace {

/// Half a unit in the last place of 1: the largest relative error of one rounding.
constexpr double ROUNDING = 0.5 * std::numeric_limits<double>::epsilon();
/// Error bounds of the filters, relative to the sum of the absolute products (Shewchuk 1997, section 4.3
/// and 4.4).
constexpr double ORIENT_3D_BOUND = (7.0 + 56.0 * ROUNDING) * ROUNDING;
constexpr double ORIENT_2D_BOUND = (3.0 + 16.0 * ROUNDING) * ROUNDING;

int sign(double value) {
  return (value > 0.0) - (value < 0.0);
}

using ExactVector = std::array<Expansion<2>, 3>;

ExactVector exact_vector(const Vec3& a, const Vec3& b) {
  return {exact_difference(a[0], b[0]), exact_difference(a[1], b[1]), exact_difference(a[2], b[2])};
}

int exact_orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const ExactVector u = exact_vector(b, a);
  const ExactVector v = exact_vector(c, a);
  const ExactVector w = exact_vector(d, a);
  return (w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
          w[2] * (u[0] * v[1] - u[1] * v[0]))
      .sign();
}

/// The plane through a, b and c with what the filter needs to bound the rounding error of a height.
struct PlaneThrough {
  const Vec3 &a, &b, &c;
  Vec3 normal;      ///< (b - a) x (c - a)
  Vec3 magnitudes;  ///< per coordinate of the normal, the sum of its absolute products

  PlaneThrough(const Vec3& corner_a, const Vec3& corner_b, const Vec3& corner_c)
      : a(corner_a), b(corner_b), c(corner_c) {
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    const double u1v2 = u[1] * v[2], u2v1 = u[2] * v[1];
    const double u2v0 = u[2] * v[0], u0v2 = u[0] * v[2];
    const double u0v1 = u[0] * v[1], u1v0 = u[1] * v[0];
    normal = {u1v2 - u2v1, u2v0 - u0v2, u0v1 - u1v0};
    magnitudes = {std::abs(u1v2) + std::abs(u2v1), std::abs(u2v0) + std::abs(u0v2),
                  std::abs(u0v1) + std::abs(u1v0)};
  }

  int side(const Vec3& d) const {
    const Vec3 w = d - a;
    const double determinant = w.dot(normal);
    const double permanent = w.cwiseAbs().dot(magnitudes);
    if (std::abs(determinant) > ORIENT_3D_BOUND * permanent) return sign(determinant);
    // A shared corner is the common reason to be here.
    if (d == a || d == b || d == c) return 0;
    return exact_orientation_3d(a, b, c, d);
  }
};

}  // namespace

std::array<int, 3> sides_of_plane(const Triangle& t, const Triangle& points) {
  const PlaneThrough plane(t[0], t[1], t[2]);
  return {plane.side(points[0]), plane.side(points[1]), plane.side(points[2])};
}

int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return PlaneThrough(a, b, c).side(d);
}

int orientation_2d(const Vec3& a, const Vec3& b, const Vec3& c, int dropped_axis) {
  const int x = (dropped_axis + 1) % 3;
  const int y = (dropped_axis + 2) % 3;
  const double left = (b[x] - a[x]) * (c[y] - a[y]);
  const double right = (b[y] - a[y]) * (c[x] - a[x]);
  const double determinant = left - right;
  if (std::abs(determinant) > ORIENT_2D_BOUND * (std::abs(left) + std::abs(right))) return sign(determinant);
  return (exact_difference(b[x], a[x]) * exact_difference(c[y], a[y]) -
          exact_difference(b[y], a[y]) * exact_difference(c[x], a[x]))
      .sign();
}

}  // namespace lmdbench
