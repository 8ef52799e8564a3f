// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/decide/touch.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lmdbench {

namespace {

/// Gap between a and b's plane, with the axis from a towards it. A zero normal separates nothing.
ClearGap gap_to_plane(const Triangle& a, const Triangle& b, const Vec3& normal_b) {
  const double h0 = normal_b.dot(a[0] - b[0]), h1 = normal_b.dot(a[1] - b[0]), h2 = normal_b.dot(a[2] - b[0]);
  const double above = std::min({h0, h1, h2}), below = -std::max({h0, h1, h2});
  return above >= below ? ClearGap{above, -normal_b} : ClearGap{below, normal_b};
}

}  // namespace

ClearGap gap_along_normals(const Triangle& a, const Vec3& normal_a, const Triangle& b, const Vec3& normal_b,
                           double margin) {
  ClearGap over_b = gap_to_plane(a, b, normal_b);
  if (over_b.gap > margin) return over_b;
  const ClearGap over_a = gap_to_plane(b, a, normal_a);
  return over_a.gap > margin ? ClearGap{over_a.gap, -over_a.axis} : ClearGap{};
}

ClearGap clear_gap(const Triangle& a, const Vec3& normal_a, const Triangle& b, const Vec3& normal_b,
                   double margin) {
  if (ClearGap gap = gap_along_normals(a, normal_a, b, normal_b, margin); gap.gap > margin) return gap;
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
      const double ahead = std::min({b0, b1, b2}) - std::max({0.0, a1, a2}),
                   behind = std::min({0.0, a1, a2}) - std::max({b0, b1, b2});
      const double gap = std::max(ahead, behind);
      if (!(gap > 0.0 && gap * gap > margin * margin * axis.squaredNorm())) continue;
      const double length = axis.norm();
      return {gap / length, (ahead > behind ? 1.0 : -1.0) / length * axis};
    }
  }
  return {};
}

}  // namespace lmdbench
