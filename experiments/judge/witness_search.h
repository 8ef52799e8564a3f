// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <array>
#include <cmath>

namespace lmdbench::testing {

/// Square root in any precision: that of long double, and one Newton step.
template <class Real>
Real root(Real x) {
  const Real start = std::sqrt(static_cast<long double>(x));
  return start > 0 ? (start + x / start) / 2 : start;
}

template <class Real>
struct WitnessVector {
  Real x = 0, y = 0, z = 0;

  friend WitnessVector operator+(const WitnessVector& a, const WitnessVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend WitnessVector operator-(const WitnessVector& a, const WitnessVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend WitnessVector operator*(Real s, const WitnessVector& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend Real dot(const WitnessVector& a, const WitnessVector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend WitnessVector cross(const WitnessVector& a, const WitnessVector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

/// A pair of points as weights of the corners, none negative, and directions in which the triangles
/// may be apart by the pair's distance.
template <class Real>
struct Witness {
  std::array<Real, 3> on_a{1, 0, 0}, on_b{1, 0, 0};
  WitnessVector<Real> normal;  ///< across both features; zero if only the pair gives it
  Real squared_distance = -1;  ///< by the search; negative for none
};

/// Searches the nearest points of two triangles: ends and insides of edge pairs, corners over
/// faces, and edges through faces. Textbook formulas without any tolerance: callers must bound the
/// error themselves.
template <class Real>
class WitnessSearch {
 public:
  using Vector = WitnessVector<Real>;
  using Corners = std::array<Vector, 3>;

  /// Corners relative to the first corner of a.
  WitnessSearch(const Triangle& triangle_a, const Triangle& triangle_b) {
    const Vec3& origin = triangle_a[0];
    for (int k = 0; k < 3; ++k) {
      a[k] = {Real(triangle_a[k][0]) - origin[0], Real(triangle_a[k][1]) - origin[1],
              Real(triangle_a[k][2]) - origin[2]};
      b[k] = {Real(triangle_b[k][0]) - origin[0], Real(triangle_b[k][1]) - origin[1],
              Real(triangle_b[k][2]) - origin[2]};
    }
  }

  Witness<Real> run() {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        corner_to_edge(a[i], b, j, [i](Witness<Real>& w, const std::array<Real, 3>& on_edge) {
          w.on_a = corner(i);
          w.on_b = on_edge;
        });
        corner_to_edge(b[j], a, i, [j](Witness<Real>& w, const std::array<Real, 3>& on_edge) {
          w.on_a = on_edge;
          w.on_b = corner(j);
        });
        edge_to_edge(i, j);
      }
    }
    over_face(a, b, false);
    over_face(b, a, true);
    return best_;
  }

  Corners a, b;

 private:
  static std::array<Real, 3> corner(int k) {
    std::array<Real, 3> weights{};
    weights[k] = 1;
    return weights;
  }
  static std::array<Real, 3> on_edge(int k, Real part) {
    std::array<Real, 3> weights{};
    weights[k] = 1 - part;
    weights[(k + 1) % 3] = part;
    return weights;
  }
  bool is_nearer(Real squared_distance) const {
    return best_.squared_distance < 0 || squared_distance < best_.squared_distance;
  }

  template <class Set>
  void corner_to_edge(const Vector& x, const Corners& t, int k, const Set& set) {
    const Vector e = t[(k + 1) % 3] - t[k];
    const Vector r = x - t[k];
    const Real squared_length = dot(e, e);
    const Real along = dot(r, e);
    const Real part = !(along > 0) ? Real(0) : along >= squared_length ? Real(1) : along / squared_length;
    const Vector d = r - part * e;
    const Real squared_distance = dot(d, d);
    if (!is_nearer(squared_distance)) return;
    best_.squared_distance = squared_distance;
    best_.normal = {};
    set(best_, on_edge(k, part));
  }

  void edge_to_edge(int i, int j) {
    const Vector u = a[(i + 1) % 3] - a[i], v = b[(j + 1) % 3] - b[j], r = b[j] - a[i];
    const Vector n = cross(u, v);
    const Real squared_n = dot(n, n);
    const Real s = dot(cross(r, v), n), t = dot(cross(r, u), n);
    if (!(squared_n > 0 && s >= 0 && s <= squared_n && t >= 0 && t <= squared_n)) return;
    const Real height = dot(r, n);
    const Real squared_distance = height * height / squared_n;
    if (!is_nearer(squared_distance)) return;
    best_ = {on_edge(i, s / squared_n), on_edge(j, t / squared_n), n, squared_distance};
  }

  /// Corners of `t` over the face, edges of `t` through it; `swap`: t is the second triangle.
  void over_face(const Corners& t, const Corners& face, bool swap) {
    const Vector e1 = face[1] - face[0], e2 = face[2] - face[0];
    const Vector n = cross(e1, e2);
    const Real squared_n = dot(n, n);
    if (!(squared_n > 0)) return;
    std::array<Real, 3> height;
    std::array<std::array<Real, 3>, 3> weights;
    for (int k = 0; k < 3; ++k) {
      const Vector w = t[k] - face[0];
      height[k] = dot(w, n);
      weights[k][1] = dot(cross(w, e2), n) / squared_n;
      weights[k][2] = dot(cross(e1, w), n) / squared_n;
      weights[k][0] = 1 - weights[k][1] - weights[k][2];
      keep_if_inside(weights[k], corner(k), n, height[k] * height[k] / squared_n, swap);
    }
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3;
      if (!((height[k] < 0 && height[l] > 0) || (height[k] > 0 && height[l] < 0))) continue;
      const Real part = height[k] / (height[k] - height[l]);
      std::array<Real, 3> meeting;
      for (int i = 1; i < 3; ++i) meeting[i] = weights[k][i] + part * (weights[l][i] - weights[k][i]);
      // From the two rounded ones: weights of far corners are large, so the sum of three roundings
      // would not be 1.
      meeting[0] = 1 - meeting[1] - meeting[2];
      keep_if_inside(meeting, on_edge(k, part), n, 0, swap);
    }
  }

  void keep_if_inside(const std::array<Real, 3>& on_face, const std::array<Real, 3>& on_t, const Vector& n,
                      Real squared_distance, bool swap) {
    if (!(on_face[0] >= 0 && on_face[1] >= 0 && on_face[2] >= 0) || !is_nearer(squared_distance)) return;
    best_ = {swap ? on_face : on_t, swap ? on_t : on_face, n, squared_distance};
  }

  Witness<Real> best_;
};

}  // namespace lmdbench::testing
