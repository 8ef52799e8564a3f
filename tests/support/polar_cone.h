// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

/// Outward polar cones by decision/DEFINITION.md from incident triangles, to check caps.
namespace lmdbench::testing {

/// @param p_S        point on the feature, mesh frame
/// @param tolerance  sine by which the direction may leave the cone
inline bool in_polar_cone(const Surface& surface, const FeatureId& feature, const Vec3& p_S, const Vec3& d_S,
                          double tolerance) {
  const auto triangles = surface.incident_triangles(feature);
  const Vec3 outer = surface.pseudo_normal(feature), direction = d_S.stableNormalized();
  if (triangles.empty() || (feature.kind == FeatureKind::FACE && outer.isZero(0.0))) return false;
  if (surface.has_outer_side(feature) && !(direction.dot(outer) > 0.0)) return false;
  return std::ranges::all_of(triangles, [&](std::int32_t t) {
    return std::ranges::all_of(surface.mesh.triangles[static_cast<std::size_t>(t)], [&](std::int32_t corner) {
      if (feature.kind == FeatureKind::VERTEX && corner == feature.index) return true;
      const Vec3 wing = surface.mesh.vertices[static_cast<std::size_t>(corner)] - p_S;
      return direction.dot(wing.stableNormalized()) <= tolerance;
    });
  });
}

/// Unit vectors of a polar cone square to two wings, all extreme ones among them. A face has one.
inline std::vector<Vec3> extreme_directions(const Surface& surface, const FeatureId& feature) {
  constexpr double ROUNDING = 1e-9;  // of the products of nearly parallel wings
  if (feature.kind == FeatureKind::FACE) {
    const Vec3 normal = surface.pseudo_normal(feature);
    return normal.isZero(0.0) ? std::vector<Vec3>{} : std::vector{normal};
  }
  const auto vertex = [&](std::int32_t v) { return surface.mesh.vertices[static_cast<std::size_t>(v)]; };
  Vec3 p = Vec3::Zero();
  const FeatureCorners ends(surface, feature);
  for (const std::int32_t v : ends.view()) p += vertex(v) / static_cast<double>(ends.view().size());
  std::vector<Vec3> wings, directions;
  for (const std::int32_t t : surface.incident_triangles(feature))
    for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(t)])
      if (const Vec3 wing = (vertex(corner) - p).stableNormalized(); !wing.isZero(0.0)) wings.push_back(wing);
  for (std::size_t i = 0; i < wings.size(); ++i)
    for (std::size_t j = i + 1; j < wings.size(); ++j) {
      const Vec3 product = wings[i].cross(wings[j]);
      if (!(product.norm() > ROUNDING)) continue;
      for (const Vec3& direction : {Vec3(product.normalized()), Vec3(-product.normalized())})
        if (in_polar_cone(surface, feature, p, direction, ROUNDING)) directions.push_back(direction);
    }
  return directions;
}

}  // namespace lmdbench::testing
