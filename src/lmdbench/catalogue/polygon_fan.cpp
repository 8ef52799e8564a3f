// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/polygon_fan.h>

#include <Eigen/Geometry>

namespace lmdbench {

std::optional<std::size_t> fan_corner(std::span<const Vec3> corners) {
  const std::size_t count = corners.size();
  const auto area_of = [&](std::size_t first, std::size_t k) -> Vec3 {
    const Vec3 &a = corners[first], &b = corners[(first + k) % count], &c = corners[(first + k + 1) % count];
    return (b - a).cross(c - a);
  };
  Vec3 area = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < count; ++k) area += area_of(0, k);
  const double least = -1e-6 * area.squaredNorm();
  for (std::size_t first = 0; first < count; ++first) {
    bool folds = false;
    for (std::size_t k = 1; k + 1 < count && !folds; ++k) folds = area_of(first, k).dot(area) < least;
    if (!folds) return first;
  }
  return std::nullopt;
}

}  // namespace lmdbench
