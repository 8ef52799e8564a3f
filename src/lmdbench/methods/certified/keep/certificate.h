// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <limits>

namespace lmdbench {

/// What the decision about a pair of features stands. For a motion that displaces the moving feature's centre
/// (wide_lifetime.h) by Delta and turns the mesh by theta, it holds while
///
///   slack - gradient . Delta - spread |Delta| - lever_arm theta > 0   and   theta < turn
struct Certificate {
  double slack = -1.0;           ///< metres; negative: must be decided again whatever the motion
  Vec3 gradient = Vec3::Zero();  ///< In the world, no longer than 1.
  double spread = 0.0;
  double lever_arm = 0.0;                                 ///< metres
  double turn = std::numeric_limits<double>::infinity();  ///< radians

  static Certificate turned(double angle) {
    return {std::numeric_limits<double>::infinity(), Vec3::Zero(), 0.0, 0.0, angle};
  }
};

}  // namespace lmdbench
