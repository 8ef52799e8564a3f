// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/first_order.h>

#include <algorithm>
#include <limits>

namespace lmdbench {

namespace {

bool has_side(const Surface& surface, const FeatureId& feature) {
  if (surface.is_boundary(feature)) return false;
  if (feature.kind == FeatureKind::EDGE)
    return !surface.edge_is_non_manifold[static_cast<std::size_t>(feature.index)];
  if (feature.kind == FeatureKind::VERTEX)
    return !surface.vertex_has_non_manifold_edge[static_cast<std::size_t>(feature.index)];
  return true;
}

}  // namespace

bool in_outward_polar_cone(const Surface& surface, const RigidTransform& X_WS, const FeatureId& feature,
                           const Vec3& p_W, const Vec3& d_W, double tolerance) {
  if (has_side(surface, feature) && !(d_W.dot(X_WS.direction(surface.pseudo_normal(feature))) > 0.0))
    return false;
  if (feature.kind == FeatureKind::FACE) return true;

  // p, q and x carry rounding of the size of their coordinates. Where |d| or |x - p| is small that is more
  // than the angle tolerance, so it is allowed for apart, in either.
  const double length = d_W.norm();
  const double coordinates = std::max(p_W.cwiseAbs().maxCoeff(), (p_W + d_W).cwiseAbs().maxCoeff());
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * coordinates;
  for (const std::int32_t triangle : surface.incident_triangles(feature)) {
    for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(triangle)]) {
      if (feature.kind == FeatureKind::VERTEX && corner == feature.index) continue;
      const Vec3 to_corner = X_WS.point(surface.mesh.vertices[static_cast<std::size_t>(corner)]) - p_W;
      if (d_W.dot(to_corner) > (tolerance * length + rounding) * to_corner.norm() + rounding * length)
        return false;
    }
  }
  return true;
}

bool is_local_minimum(const Surface& moving, const RigidTransform& X_WM, const Surface& fixed, const Lmd& lmd,
                      double tolerance) {
  if (lmd.intersecting || lmd.distance == 0.0) return true;
  static const RigidTransform identity;
  const Vec3 d_W = lmd.point_fixed - lmd.point_moving;
  return in_outward_polar_cone(moving, X_WM, lmd.feature_moving, lmd.point_moving, d_W, tolerance) &&
         in_outward_polar_cone(fixed, identity, lmd.feature_fixed, lmd.point_fixed, -d_W, tolerance);
}

}  // namespace lmdbench
