// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/convex_polygon.h>

#include <support/scenes.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace lmdbench::testing {

/// At least three corners, around the origin, on a circle of radius 1 or a thin ellipse.
inline ConvexPolygon random_convex_polygon(std::mt19937_64& random, int count) {
  std::vector<double> angles;
  const double start = 2.0 * std::numbers::pi * uniform(random);
  // One angle in each of `count` sectors: not all nearly equal, and not all on one side.
  for (int k = 0; k < count; ++k)
    angles.push_back(start + 2.0 * std::numbers::pi * (k + 0.8 * uniform(random)) / count);
  const double flat = random() % 3 == 0 ? 0.05 : 1.0;
  ConvexPolygon polygon;
  for (const double angle : angles) polygon.corners.emplace_back(std::cos(angle), flat * std::sin(angle));
  return polygon;
}

}  // namespace lmdbench::testing
