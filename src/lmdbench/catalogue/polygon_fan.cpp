// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/polygon_fan.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>

namespace lmdbench {
namespace {

/// The first corner from which no triangle of the fan folds.
/// @param at place of a corner
std::optional<std::size_t> fan_corner(std::size_t count, const auto& at) {
  if (count == 3) return 0;
  const auto area_of = [&](std::size_t first, std::size_t k) -> Vec3 {
    return (at(first + k) - at(first)).cross(at(first + k + 1) - at(first));
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

}  // namespace

void add_polygon(std::span<const std::int32_t> polygon, const LineReader& lines, TriangleMesh& mesh) {
  const std::size_t count = polygon.size();
  if (static_cast<std::int64_t>(count) > limit_of(Limit::POLYGON_CORNERS))
    lines.fail(fmt::format("a polygon of {} corners, above the limit of {}", count,
                           limit_of(Limit::POLYGON_CORNERS)),
               "cut it into triangles where it was made, or " + raise_remedy(Limit::POLYGON_CORNERS));
  const auto corner = [&](std::size_t k) { return polygon[k % count]; };
  const std::optional<std::size_t> first = fan_corner(count, [&](std::size_t k) -> const Vec3& {
    return mesh.vertices[static_cast<std::size_t>(corner(k))];
  });
  if (!first)
    lines.fail("a polygon that no fan of triangles fills", "cut it into triangles where it was made");
  for (std::size_t k = 1; k + 1 < count; ++k)
    mesh.triangles.push_back({corner(*first), corner(*first + k), corner(*first + k + 1)});
  if (static_cast<std::int64_t>(mesh.triangles.size()) > limit_of(Limit::TRIANGLES))
    lines.fail(fmt::format("more triangles than the limit of {}", limit_of(Limit::TRIANGLES)),
               "decimate the mesh, or " + raise_remedy(Limit::TRIANGLES));
}

}  // namespace lmdbench
