// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/motion/interpolate.h>

#include <cstddef>

namespace lmdbench {

/// What a path is like, seen at a frame rate.
struct PathFacts {
  std::size_t pose_count = 0;     ///< As stored.
  std::size_t frame_count = 0;    ///< At the frame rate.
  double start_time = 0.0;        ///< seconds
  double sample_interval = 0.0;   ///< Median between stored poses [s]; NaN for a single pose.
  double longest_interval = 0.0;  ///< seconds
  std::size_t gaps = 0;           ///< Intervals that are held, not interpolated.
  double duration = 0.0;          ///< seconds
  double length = 0.0;            ///< Travelled by the mesh frame's origin [m].
  double turning = 0.0;           ///< Angle turned in all [rad].
  // Largest finite differences between neighbouring frames; NaN where there are too few frames.
  double maximum_speed = 0.0;                 ///< m/s
  double maximum_acceleration = 0.0;          ///< m/s^2
  double maximum_angular_speed = 0.0;         ///< rad/s
  double maximum_angular_acceleration = 0.0;  ///< rad/s^2
  Vec3 lower_corner;                          ///< Of the box of the mesh frame's origin [m].
  Vec3 upper_corner;
};

/// @param rate frames a second [Hz], > 0
PathFacts path_facts(const PathInterpolator& interpolator, double rate);

}  // namespace lmdbench
