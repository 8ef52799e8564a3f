// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>

namespace lmdbench {

/// The least and the greatest of some numbers; of none, the least is above the greatest.
struct Extent {
  double least = std::numeric_limits<double>::infinity(), greatest = -std::numeric_limits<double>::infinity();

  void add(double x) {
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
};

/// Of points along an axis, times its length.
template <class Points, class Axis>
Extent extent_along(const Points& points, const Axis& axis) {
  Extent extent;
  for (const auto& x : points) extent.add(axis.dot(x));
  return extent;
}

}  // namespace lmdbench
