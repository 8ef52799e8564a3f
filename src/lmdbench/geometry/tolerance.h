// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace lmdbench {

/// A length below this part of the largest coordinate is rounding: points that close coincide, and edges or
/// faces that drift apart by less are parallel. A corner that went through a rigid transform carries about
/// four roundings per coordinate and an edge two such corners, so sixteen epsilons cover what a common
/// rotation does to two parallel edges; the error of a distance from taking them as parallel stays under
/// 1e-14 of the coordinates.
inline constexpr double COINCIDENCE_TOLERANCE = 16.0 * std::numeric_limits<double>::epsilon();

/// Largest absolute coordinate; NaN or infinite where a coordinate is.
inline double largest_coordinate(std::span<const Vec3> points) {
  double largest = 0.0;
  for (const Vec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      const double magnitude = std::abs(point[axis]);
      largest =
          magnitude <= largest ? largest : magnitude;  // takes a NaN over, and the next finite one keeps it
      if (std::isnan(magnitude)) return magnitude;
    }
  }
  return largest;
}

/// COINCIDENCE_TOLERANCE times the coordinate magnitude rounded down to a power of two, so that queries which
/// share features but not all corners nearly always decide by the same length.
inline double coincidence_length(double magnitude) {
  if (!(magnitude > 0.0)) return 0.0;
  return COINCIDENCE_TOLERANCE * std::ldexp(1.0, std::ilogb(magnitude));
}

/// Lexicographic order of coordinates: the canonical order of corners.
inline bool lexicographic_less(const Vec3& a, const Vec3& b) {
  if (a[0] != b[0]) return a[0] < b[0];
  if (a[1] != b[1]) return a[1] < b[1];
  return a[2] < b[2];
}

}  // namespace lmdbench
