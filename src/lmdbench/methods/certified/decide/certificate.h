// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <limits>

namespace lmdbench {

/// For which motions the decision about a pair of features stays valid. While the moving feature's
/// centre (wide_lifetime.h) moves by Delta and the mesh turns by theta, it is valid as long as
///
///   slack - gradient . Delta - spread |Delta| - lever_arm theta > 0   and   theta < turn
struct Certificate {
  double slack = -1.0;           ///< metres; negative: decided again in every frame
  Vec3 gradient = Vec3::Zero();  ///< In the world, no longer than 1.
  double spread = 0.0;
  double lever_arm = 0.0;                                 ///< metres
  double turn = std::numeric_limits<double>::infinity();  ///< radians

  static Certificate turned(double angle) {
    return {std::numeric_limits<double>::infinity(), Vec3::Zero(), 0.0, 0.0, angle};
  }
};

}  // namespace lmdbench
