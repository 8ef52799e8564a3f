// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {

/// Square of `longest_side` [m^2].
inline double squared_longest_side(const Triangle& t) {
  return std::max({(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm()});
}

/// Length of a triangle's longest side [m].
inline double longest_side(const Triangle& t) {
  return std::sqrt(squared_longest_side(t));
}

/// A triangle's least altitude, on its longest side [m]; 0 where the corners are at one point.
inline double least_altitude(const Triangle& t) {
  const double longest = longest_side(t);
  return longest > 0.0 ? (t[1] - t[0]).cross(t[2] - t[0]).norm() / longest : 0.0;
}

}  // namespace lmdbench
