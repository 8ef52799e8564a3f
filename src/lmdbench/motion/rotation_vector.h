// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <Eigen/Geometry>

namespace lmdbench {

/// Rotation vector (axis times angle, radians) of a unit quaternion along the shorter arc: length
/// in [0, pi], the same for q and -q. Accurate for tiny rotations.
Vec3 rotation_vector_of(const Eigen::Quaterniond& rotation);

/// Unit quaternion of a rotation vector; accurate for tiny rotations.
Eigen::Quaterniond rotation_of(const Vec3& rotation_vector);

}  // namespace lmdbench
