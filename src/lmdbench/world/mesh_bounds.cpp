// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/contact_tolerance.h>
#include <lmdbench/mesh/radius_about.h>
#include <lmdbench/world/mesh_bounds.h>

#include <algorithm>

namespace lmdbench {

MeshBounds MeshBounds::of(const Surface& surface) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : surface.mesh.vertices) box.extend(vertex);
  MeshBounds bounds;
  bounds.known = surface.mesh.planar_tolerance;
  if (box.isEmpty()) return bounds;
  bounds.centre = box.center();
  bounds.half_sides = 0.5 * box.sizes();
  bounds.radius = radius_about(surface.mesh, bounds.centre);
  // The largest coordinate is bounded by the sphere.
  bounds.known = std::max(bounds.known, LEAST_TOLERANCE * (bounds.centre.norm() + bounds.radius));
  return bounds;
}

Eigen::AlignedBox3d MeshBounds::placed(const RigidTransform& X_WF) const {
  const Vec3 middle = X_WF.point(centre);
  const Vec3 turned = X_WF.rotation.cwiseAbs() * half_sides;
  const Vec3 half =
      turned.cwiseMin(Vec3::Constant(radius)) + Vec3::Constant(PLACING_ROUNDING * coordinates(X_WF));
  return {middle - half, middle + half};
}

Pose relative_pose(const Pose& X_WF, const Pose& X_WM) {
  const Eigen::Quaterniond R_FW = X_WF.rotation.conjugate();
  return {R_FW * (X_WM.translation - X_WF.translation), (R_FW * X_WM.rotation).normalized()};
}

}  // namespace lmdbench
