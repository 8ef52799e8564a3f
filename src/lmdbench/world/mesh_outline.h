// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/surface.h>

#include <Eigen/Geometry>

namespace lmdbench {

/// A mesh as a few dozen spheres that hold its triangles, in its own frame: what tells two meshes apart whose boxes overlap. Made once a
/// mesh, however many instances there are.
struct MeshOutline {
  Eigen::ArrayXd x, y, z, radius;  ///< One a sphere [m].
  Eigen::AlignedBox3d box;         ///< Of the mesh.

  /// Splits the triangles in halves along the longest side of their middles' box, until there are `OUTLINE_SPHERES` parts.
  static MeshOutline of(const Surface& surface);
};

inline constexpr int OUTLINE_SPHERES = 64;

/// Lower bound of the distance of two meshes, or any number not above `enough` where it is not above that [m].
/// @param X_FM from the moving mesh's frame to the fixed one's
double outline_distance(const MeshOutline& moving, const MeshOutline& fixed, const RigidTransform& X_FM,
                        double enough);

}  // namespace lmdbench
