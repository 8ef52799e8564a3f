// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/expansion.h>
#include <lmdbench/geometry/orientation.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace lmdbench {
namespace {

/// Half a unit in the last place of 1: the largest relative error of one rounding.
constexpr double ROUNDING = 0.5 * std::numeric_limits<double>::epsilon();
/// The same for the widest type of the processor; where that is double, its filter decides nothing.
constexpr long double EXTENDED_ROUNDING = 0.5L * std::numeric_limits<long double>::epsilon();
/// Error bounds of the filters, relative to the sum of the absolute products
/// (Shewchuk 1997, section 4.3 and 4.4).
constexpr double ORIENT_3D_BOUND = (7.0 + 56.0 * ROUNDING) * ROUNDING;
constexpr long double EXTENDED_3D_BOUND = (7.0L + 56.0L * EXTENDED_ROUNDING) * EXTENDED_ROUNDING;
constexpr double ORIENT_2D_BOUND = (3.0 + 16.0 * ROUNDING) * ROUNDING;
template <class Real>
int sign(Real value) {
  return (value > 0) - (value < 0);
}

/// The error of a larger product does not underflow.
constexpr double LEAST_PRODUCT = 0x1p-900;

/// A number with a flag that it is exact. Coordinates on a lattice, and corners that share
/// coordinates, keep every operation exact; then the sign needs no more terms.
struct Tracked {
  double value;
  bool exact;
};

Tracked difference(double a, double b) {
  const double value = a - b;
  const double virtual_part = a - value;
  return {value, virtual_part == b && value + virtual_part == a};
}
Tracked operator-(const Tracked& a, const Tracked& b) {
  const Tracked result = difference(a.value, b.value);
  return {result.value, result.exact && a.exact && b.exact};
}
Tracked operator+(const Tracked& a, const Tracked& b) {
  const Tracked result = difference(a.value, -b.value);
  return {result.value, result.exact && a.exact && b.exact};
}
Tracked operator*(const Tracked& a, const Tracked& b) {
  const double value = a.value * b.value;
  const bool is_zero = a.value == 0.0 || b.value == 0.0;
  const bool has_exact_error = std::abs(value) > LEAST_PRODUCT;
  const bool can_tell = a.exact && b.exact && (is_zero || has_exact_error);
  return {value, can_tell && std::fma(a.value, b.value, -value) == 0.0};
}

using ExactVector = std::array<Expansion<2>, 3>;

ExactVector exact_vector(const Vec3& a, const Vec3& b) {
  return {exact_difference(a[0], b[0]), exact_difference(a[1], b[1]), exact_difference(a[2], b[2])};
}

std::optional<int> tracked_orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::array<Tracked, 3> u, v, w;
  for (int k = 0; k < 3; ++k) {
    u[k] = difference(b[k], a[k]);
    v[k] = difference(c[k], a[k]);
    w[k] = difference(d[k], a[k]);
    if (!(u[k].exact && v[k].exact && w[k].exact)) return std::nullopt;
  }
  const Tracked determinant = w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
                              w[2] * (u[0] * v[1] - u[1] * v[0]);
  if (!determinant.exact) return std::nullopt;
  return sign(determinant.value);
}

std::optional<int> extended_orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  using Real = long double;
  const Real u0 = Real(b[0]) - a[0], u1 = Real(b[1]) - a[1], u2 = Real(b[2]) - a[2];
  const Real v0 = Real(c[0]) - a[0], v1 = Real(c[1]) - a[1], v2 = Real(c[2]) - a[2];
  const Real w0 = Real(d[0]) - a[0], w1 = Real(d[1]) - a[1], w2 = Real(d[2]) - a[2];
  const Real u1v2 = u1 * v2, u2v1 = u2 * v1, u2v0 = u2 * v0, u0v2 = u0 * v2, u0v1 = u0 * v1, u1v0 = u1 * v0;
  const Real determinant = w0 * (u1v2 - u2v1) + w1 * (u2v0 - u0v2) + w2 * (u0v1 - u1v0);
  const Real permanent = std::abs(w0) * (std::abs(u1v2) + std::abs(u2v1)) +
                         std::abs(w1) * (std::abs(u2v0) + std::abs(u0v2)) +
                         std::abs(w2) * (std::abs(u0v1) + std::abs(u1v0));
  if (!(std::abs(determinant) > EXTENDED_3D_BOUND * permanent)) return std::nullopt;
  return sign(determinant);
}

int exact_orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const ExactVector u = exact_vector(b, a);
  const ExactVector v = exact_vector(c, a);
  const ExactVector w = exact_vector(d, a);
  return (w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
          w[2] * (u[0] * v[1] - u[1] * v[0]))
      .sign();
}

/// All four points have one coordinate in common.
bool is_across_an_axis(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return ((a.array() == b.array()) && (b.array() == c.array()) && (c.array() == d.array())).any();
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
    // First the common cases: shared corners, axis-parallel planes. Then lattices and rounding.
    if (d == a || d == b || d == c || a == b || b == c || c == a) return 0;
    if (is_across_an_axis(a, b, c, d)) return 0;
    if (const auto result = tracked_orientation_3d(a, b, c, d)) return *result;
    if (const auto result = extended_orientation_3d(a, b, c, d)) return *result;
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
  const Tracked tracked =
      difference(b[x], a[x]) * difference(c[y], a[y]) - difference(b[y], a[y]) * difference(c[x], a[x]);
  if (tracked.exact) return sign(tracked.value);
  return (exact_difference(b[x], a[x]) * exact_difference(c[y], a[y]) -
          exact_difference(b[y], a[y]) * exact_difference(c[x], a[x]))
      .sign();
}

}  // namespace lmdbench
