// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/certified_touch.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lmdbench {

namespace {

/// Distance of a from b's plane; negative when it is cut. A zero normal separates nothing.
double gap_to_plane(const Triangle& a, const Triangle& b, const Vec3& normal_b) {
  const double h0 = normal_b.dot(a[0] - b[0]), h1 = normal_b.dot(a[1] - b[0]), h2 = normal_b.dot(a[2] - b[0]);
  return std::max(std::min({h0, h1, h2}), -std::max({h0, h1, h2}));
}

}  // namespace

double clear_gap(const Triangle& a, const Vec3& normal_a, const Triangle& b, const Vec3& normal_b,
                 double margin) {
  const double over_b = gap_to_plane(a, b, normal_b);
  if (over_b > margin) return over_b;
  const double over_a = gap_to_plane(b, a, normal_a);
  if (over_a > margin) return over_a;
  // Everything from a's first corner: differences of nearby points, no large coordinates.
  const Vec3& origin = a[0];
  const std::array<Vec3, 2> corners_a{a[1] - origin, a[2] - origin};
  const std::array<Vec3, 3> corners_b{b[0] - origin, b[1] - origin, b[2] - origin};
  const std::array<Vec3, 3> sides_a{corners_a[0], corners_a[1] - corners_a[0], -corners_a[1]};
  const std::array<Vec3, 3> sides_b{corners_b[1] - corners_b[0], corners_b[2] - corners_b[1],
                                    corners_b[0] - corners_b[2]};
  for (const Vec3& side_a : sides_a) {
    for (const Vec3& side_b : sides_b) {
      const Vec3 axis = side_a.cross(side_b);
      const double a1 = axis.dot(corners_a[0]), a2 = axis.dot(corners_a[1]);
      const double b0 = axis.dot(corners_b[0]), b1 = axis.dot(corners_b[1]), b2 = axis.dot(corners_b[2]);
      const double gap = std::max(std::min({b0, b1, b2}) - std::max({0.0, a1, a2}),
                                  std::min({0.0, a1, a2}) - std::max({b0, b1, b2}));
      if (gap > 0.0 && gap * gap > margin * margin * axis.squaredNorm()) return gap / axis.norm();
    }
  }
  return 0.0;
}

}  // namespace lmdbench
