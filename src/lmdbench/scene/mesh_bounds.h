// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/surface.h>

#include <Eigen/Geometry>

namespace lmdbench {

/// Box and sphere of a mesh in its own frame: all that a broad phase knows of its shape, made once however many instances there are.
struct MeshBounds {
  Vec3 centre = Vec3::Zero();      ///< Of both.
  Vec3 half_sides = Vec3::Zero();  ///< [m]
  double radius = 0.0;             ///< Of the farthest vertex about the centre [m].
  double known = 0.0;  ///< At least what the definition knows the mesh to (decision/contact_tolerance.h) [m].

  static MeshBounds of(const Surface& surface);

  /// A box of the world that holds the placed mesh: that of the turned box or of the sphere, whichever is narrower, grown by rounding.
  Eigen::AlignedBox3d placed(const RigidTransform& X_WF) const;
  /// Bound of the coordinates of the placed mesh, from the world's origin [m].
  double coordinates(const RigidTransform& X_WF) const {
    return X_WF.translation.norm() + centre.norm() + radius;
  }
};

/// Placing a point and measuring from it is off by less, relative to the coordinates: six operations of double precision, several times over.
inline constexpr double PLACING_ROUNDING = 1e-14;

/// X_FM = X_WF^-1 X_WM, the pose in which everybody sees a moving mesh and an instance: the difference of the translations comes first,
/// which is exact for what is near each other, however far both are from the world's origin.
Pose relative_pose(const Pose& X_WF, const Pose& X_WM);

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
