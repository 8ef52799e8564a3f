// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/types.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace lmdbench::kernel {

/// A triangle's plane, held as its longest edge e = b - a and the altitude h on it, with c = a + u
/// e + h.
/// Both are accurate to a few roundings of the edge's length whatever the aspect ratio, where the
/// cross product of two edges of a needle loses every digit. Two divisions along e and h give the
/// weights of a projected point.
struct FaceFrame {
  Vec3 a, e, h, ca;        ///< ca = c - a
  double squared_e = 0.0;  ///< |e|^2
  double squared_h = 0.0;  ///< |h|^2
  double u = 0.0;
  Vec3 squared_heights;  ///< squared altitudes through a, b and c
  double squared_tolerance;
  std::array<int, 3> corner{0, 1, 2};  ///< which corners a, b and c are
  bool has_face = false;               ///< false: the altitude is rounding, a segment or point

  /// Weights of corners a, b, c of the projection of x.
  struct Weights {
    double a, b, c;
  };

  FaceFrame(const Triangle& corners, double tolerance) : squared_tolerance(tolerance * tolerance) {
    const double squared_01 = (corners[1] - corners[0]).squaredNorm();
    const double squared_12 = (corners[2] - corners[1]).squaredNorm();
    const double squared_20 = (corners[0] - corners[2]).squaredNorm();
    const int from_12 = squared_12 > squared_01;
    const int first = squared_20 > (from_12 ? squared_12 : squared_01) ? 2 : from_12;
    corner = {first, (first + 1) % 3, (first + 2) % 3};
    a = corners[corner[0]];
    e = corners[corner[1]] - a;
    ca = corners[corner[2]] - a;
    squared_e = e.squaredNorm();
    if (!(squared_e > 0.0)) return;
    u = ca.dot(e) / squared_e;
    h = ca - u * e;
    squared_h = h.squaredNorm();
    has_face = squared_h > squared_tolerance;
    if (!has_face) return;
    const double squared_double_area = squared_e * squared_h;
    squared_heights = {squared_double_area / (ca - e).squaredNorm(), squared_double_area / ca.squaredNorm(),
                       squared_h};
  }

  Weights weights(const Vec3& x) const {
    const Vec3 from_a = x - a;
    const double s = from_a.dot(e) / squared_e;
    const double t = (from_a - s * e).dot(h) / squared_h;
    const double b = s - u * t;
    return {1.0 - t - b, b, t};
  }

  /// Squared distance of the projection from the nearest edge line.
  double squared_distance_to_border(const Weights& w) const {
    return std::min(w.a * w.a * squared_heights[0],
                    std::min(w.b * w.b * squared_heights[1], w.c * w.c * squared_heights[2]));
  }

  /// Inside, and farther than the tolerance from every edge.
  bool is_interior(const Weights& w) const {
    return w.a > 0.0 && w.b > 0.0 && w.c > 0.0 && squared_distance_to_border(w) > squared_tolerance;
  }

  /// Farther than the tolerance outside some edge.
  bool is_outside(const Weights& w) const {
    const auto is_beyond = [this](double weight, double squared_height) {
      return weight < 0.0 && weight * weight * squared_height > squared_tolerance;
    };
    return is_beyond(w.a, squared_heights[0]) || is_beyond(w.b, squared_heights[1]) ||
           is_beyond(w.c, squared_heights[2]);
  }

  Vec3 point(const Weights& w) const { return a + w.b * e + w.c * ca; }

  Vec3 unit_normal() const { return e.cross(h) / std::sqrt(squared_e * squared_h); }
};

}  // namespace lmdbench::kernel
