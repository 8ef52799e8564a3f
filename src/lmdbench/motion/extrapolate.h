// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>

namespace lmdbench {

/// Pose that a body which moved from `before` to `now` in one frame reaches `frames` frames after `now` when it goes on at
/// the same velocity and angular velocity, both in the world frame.
/// @param frames any number of at least 0
Pose extrapolated(const Pose& before, const Pose& now, double frames);

}  // namespace lmdbench
