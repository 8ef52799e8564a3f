// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>

#include <vector>

namespace lmdbench {

/// Pose of the moving mesh at a time.
struct TimedPose {
  double time = 0.0;  ///< seconds
  Pose pose;          ///< X_WM
};

/// A recorded path: strictly increasing times, at least one pose.
using Path = std::vector<TimedPose>;

}  // namespace lmdbench
