// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/motion/rotation_vector.h>

#include <cmath>

namespace lmdbench {

Vec3 rotation_vector_of(const Eigen::Quaterniond& rotation) {
  LMDBENCH_EXPECTS(std::abs(rotation.squaredNorm() - 1.0) <= UNIT_TOLERANCE,
                   "a quaternion that was not normalised");
  const double sine = rotation.vec().stableNorm();  // of half the angle, >= 0
  // The shorter arc has a cosine of half the angle >= 0: take the sign into the axis.
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
  if (sine == 0.0) return Vec3::Zero();
  // atan2 and not acos: near 0 the cosine holds none of a small angle's digits.
  const double angle = 2.0 * std::atan2(sine, sign * rotation.w());
  return rotation.vec() * (sign * angle / sine);
}

Eigen::Quaterniond rotation_of(const Vec3& rotation_vector) {
  const double angle = rotation_vector.stableNorm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  Eigen::Quaterniond rotation;
  rotation.w() = std::cos(0.5 * angle);
  rotation.vec() = rotation_vector * (std::sin(0.5 * angle) / angle);
  return rotation;
}

}  // namespace lmdbench
