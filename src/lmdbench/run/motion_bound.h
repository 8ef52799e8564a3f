// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/radius_about.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <algorithm>

namespace lmdbench {

/// How far a point of the moving mesh can get between two poses.
class MotionBound {
 public:
  /// Part of the lengths involved that rounding may take from a bound on a motion.
  static constexpr double ROUNDING = 1e-12;

  /// @param farther how far points may be from where the mesh has them, as it deforms [m]
  explicit MotionBound(const TriangleMesh& mesh, double farther = 0.0)
      : centre_(bounding_box_centre(mesh)), radius_(radius_about(mesh, centre_) + farther) {}

  /// The way of the centre, and of the point farthest from it as the mesh turns: a chord.
  double between(const Pose& a, const Pose& b) const {
    const double way = (RigidTransform(b).point(centre_) - RigidTransform(a).point(centre_)).norm();
    const double half_turn_sine = (a.rotation.conjugate() * b.rotation).vec().norm();
    return way + 2.0 * radius_ * std::min(half_turn_sine, 1.0);
  }
  /// Rounding of that, at poses as far out as these.
  double slack(const Pose& a, const Pose& b) const {
    return ROUNDING * (radius_ + centre_.norm() + a.translation.norm() + b.translation.norm());
  }

 private:
  Vec3 centre_;
  double radius_;
};

}  // namespace lmdbench
