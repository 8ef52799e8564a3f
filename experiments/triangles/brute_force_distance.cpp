// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <triangles/brute_force_distance.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lmdbench::testing {
namespace {

using Real = long double;

struct Vector {
  Real x, y, z;
};

Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector operator*(Real s, const Vector& a) {
  return {s * a.x, s * a.y, s * a.z};
}
Real dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Real length(const Vector& a) {
  return std::sqrt(dot(a, a));
}

using Corners = std::array<Vector, 3>;

/// Share of the largest coordinate below which an altitude counts as zero.
constexpr Real FLAT = 1e-18L;

Real largest(const Corners& t) {
  Real result = 0;
  for (const Vector& p : t) result = std::max({result, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return result;
}

Corners extended(const Triangle& t) {
  Corners result;
  for (int i = 0; i < 3; ++i) result[i] = {t[i][0], t[i][1], t[i][2]};
  return result;
}

Real to_segment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector d = b - a;
  const Real squared_length = dot(d, d);
  if (squared_length == 0) return length(p - a);
  const Real s = std::clamp<Real>(dot(p - a, d) / squared_length, 0, 1);
  return length(p - (a + s * d));
}

/// Distance of the first segment's point nearest to the second line from the second segment: always
/// feasible, and the minimum where both feet of the common perpendicular are inside.
Real between_interiors(const Vector& a0, const Vector& a1, const Vector& b0, const Vector& b1) {
  const Vector u = a1 - a0, v = b1 - b0, w = b0 - a0;
  const Vector n = cross(u, v);
  const Real squared_n = dot(n, n);
  if (squared_n == 0) return INFINITY;
  const Real s = std::clamp<Real>(dot(cross(w, v), n) / squared_n, 0, 1);
  return to_segment(a0 + s * u, b0, b1);
}

/// Whether p projects on the inside of the triangle, by weights of the corners.
bool projects_inside(const Vector& p, const Corners& t, const Vector& n) {
  for (int k = 0; k < 3; ++k) {
    if (dot(cross(t[(k + 1) % 3] - t[k], p - t[k]), n) < 0) return false;
  }
  return true;
}

Real corners_and_edges_to_face(const Corners& from, const Corners& t) {
  const Vector n = cross(t[1] - t[0], t[2] - t[0]);
  const Real length_n = length(n);
  int longest = 0;
  for (int k = 1; k < 3; ++k) {
    if (length(t[(k + 1) % 3] - t[k]) > length(t[(longest + 1) % 3] - t[longest])) longest = k;
  }
  const Vector e = t[(longest + 1) % 3] - t[longest];
  // A flatter triangle's normal is rounding; its face is no farther from its edges than this.
  if (!(length_n > FLAT * largest(t) * length(e))) return INFINITY;
  Real best = INFINITY;
  std::array<Real, 3> height;
  // Heights are measured from the foot on the longest edge. Rounding may turn a needle's normal
  // about that edge; this tilts the plane only across the needle, where it has no extent.
  for (int k = 0; k < 3; ++k) {
    const Vector r = from[k] - t[longest];
    height[k] = dot(r - dot(r, e) / dot(e, e) * e, n) / length_n;
    if (projects_inside(from[k], t, n)) best = std::min(best, std::abs(height[k]));
  }
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    if (!((height[k] < 0 && height[l] > 0) || (height[k] > 0 && height[l] < 0))) continue;
    const Vector piercing = from[k] + height[k] / (height[k] - height[l]) * (from[l] - from[k]);
    if (projects_inside(piercing, t, n)) return 0;
  }
  return best;
}

}  // namespace

long double brute_force_distance(const Triangle& triangle_a, const Triangle& triangle_b) {
  const Corners a = extended(triangle_a), b = extended(triangle_b);
  Real best = std::min(corners_and_edges_to_face(a, b), corners_and_edges_to_face(b, a));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vector &a0 = a[i], &a1 = a[(i + 1) % 3], &b0 = b[j], &b1 = b[(j + 1) % 3];
      best =
          std::min({best, to_segment(a0, b0, b1), to_segment(b0, a0, a1), between_interiors(a0, a1, b0, b1)});
    }
  }
  return best;
}

}  // namespace lmdbench::testing
