// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/types.h>

#include <Eigen/Geometry>

namespace lmdbench {

/// Rigid transform X_WM of the moving mesh's frame M: p_W = rotation * p_M + translation.
struct Pose {
  Vec3 translation = Vec3::Zero();                               ///< p_WM, metres.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< R_WM, unit length.

  Pose inverse() const {
    const Eigen::Quaterniond inverse_rotation = rotation.conjugate();
    return {-(inverse_rotation * translation), inverse_rotation};
  }
  /// X_AC = X_AB * X_BC.
  Pose operator*(const Pose& other) const {
    return {rotation * other.translation + translation, (rotation * other.rotation).normalized()};
  }
};

/// A pose with its rotation expanded to a matrix, for inner loops. Every method transforms points
/// with this one expression, so that the same vertex has the same bits everywhere.
struct RigidTransform {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();

  RigidTransform() = default;
  explicit RigidTransform(const Pose& pose)
      : rotation(pose.rotation.toRotationMatrix()), translation(pose.translation) {
    LMDBENCH_EXPECTS(std::abs(pose.rotation.squaredNorm() - 1.0) <= UNIT_TOLERANCE,
                     "a quaternion that was read or extrapolated and not normalised");
  }

  Vec3 point(const Vec3& p) const { return rotation * p + translation; }
  Vec3 direction(const Vec3& d) const { return rotation * d; }
  Triangle triangle(const Triangle& t) const { return {point(t[0]), point(t[1]), point(t[2])}; }
};

}  // namespace lmdbench
