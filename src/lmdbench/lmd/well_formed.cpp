// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/types.h>
#include <lmdbench/lmd/well_formed.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lmdbench {

namespace {

/// Over the coordinates: above the loss far from the origin (near_frame.h), below any distance.
constexpr double DISTANCE_ROUNDING = 1e-9;

bool holds_feature(const Surface& surface, std::int32_t triangle, const FeatureId& feature) {
  return triangle >= 0 && static_cast<std::size_t>(triangle) < surface.mesh.triangles.size() &&
         surface.holds(triangle, feature);
}

}  // namespace

bool is_well_formed(const Lmd& lmd, const Scene& scene) {
  if (lmd.fixed_body < 0 || static_cast<std::size_t>(lmd.fixed_body) >= scene.fixed.size()) return false;
  const Surface &moving = scene.moving->surface(),
                &fixed = scene.fixed[static_cast<std::size_t>(lmd.fixed_body)]->surface();
  if (!holds_feature(moving, lmd.triangle_moving, lmd.feature_moving) ||
      !holds_feature(fixed, lmd.triangle_fixed, lmd.feature_fixed))
    return false;
  if (!(lmd.distance >= 0.0)) return false;
  if (lmd.distance > 0.0 && !is_unit(lmd.direction)) return false;
  double coordinates =
      std::max(lmd.point_moving.cwiseAbs().maxCoeff(), lmd.point_fixed.cwiseAbs().maxCoeff());
  // Points next to the origin carry the rounding of their triangles.
  for (const Triangle& t :
       {moving.mesh.triangle(lmd.triangle_moving), fixed.mesh.triangle(lmd.triangle_fixed)})
    for (const Vec3& corner : t) coordinates = std::max(coordinates, corner.cwiseAbs().maxCoeff());
  const double apart = (lmd.point_fixed - lmd.point_moving).norm();
  return std::abs(apart - lmd.distance) <= DISTANCE_ROUNDING * (coordinates + lmd.distance);
}

bool is_well_formed(const LmdSet& lmds, const Scene& scene) {
  return std::ranges::is_sorted(lmds, lmd_less) &&
         std::ranges::all_of(lmds, [&](const Lmd& lmd) { return is_well_formed(lmd, scene); });
}

}  // namespace lmdbench
