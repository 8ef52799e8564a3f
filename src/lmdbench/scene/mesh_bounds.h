// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/surface.h>

#include <Eigen/Geometry>

namespace lmdbench {

/// Box and sphere of a mesh in its own frame, for the broad phase; one for all its instances.
struct MeshBounds {
  Vec3 centre = Vec3::Zero();      ///< Of both.
  Vec3 half_sides = Vec3::Zero();  ///< [m]
  double radius = 0.0;             ///< Of the farthest vertex about the centre [m].
  double known = 0.0;              ///< At least its tolerance (decision/contact_tolerance.h) [m].

  static MeshBounds of(const Surface& surface);

  /// World box of the placed mesh: the narrower of turned box and sphere, grown by rounding.
  Eigen::AlignedBox3d placed(const RigidTransform& X_WF) const;
  /// Bound of the coordinates of the placed mesh, from the world's origin [m].
  double coordinates(const RigidTransform& X_WF) const {
    return X_WF.translation.norm() + centre.norm() + radius;
  }
};

/// Over the coordinates: bound of the rounding of six operations that place and measure a point.
inline constexpr double PLACING_ROUNDING = 1e-14;

/// X_FM = X_WF^-1 X_WM, the pose at which all see a moving mesh and an instance. Translations are
/// subtracted first: exact for near meshes, however far from the world's origin.
Pose relative_pose(const Pose& X_WF, const Pose& X_WM);

/// A mesh as a few dozen spheres that hold its triangles, in its own frame: for meshes whose boxes
/// overlap. One a mesh, however many instances.
struct MeshOutline {
  Eigen::ArrayXd x, y, z, radius;  ///< One a sphere [m].
  Eigen::AlignedBox3d box;         ///< Of the mesh.

  /// Halves the triangles along the longest side of their middles' box, to `OUTLINE_SPHERES` parts.
  static MeshOutline of(const Surface& surface);
};

inline constexpr int OUTLINE_SPHERES = 64;

/// Lower bound of the distance of two meshes; any number <= `enough` if it is not above that [m].
/// @param X_FM from the moving mesh's frame to the fixed one's
double outline_distance(const MeshOutline& moving, const MeshOutline& fixed, const RigidTransform& X_FM,
                        double enough);

}  // namespace lmdbench
