// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <Eigen/Geometry>

#include <array>
#include <random>
#include <vector>

namespace lmdbench {

/// A uniformly distributed rotation (Shoemake 1992).
Eigen::Quaterniond uniform_rotation(std::mt19937_64& generator);

/// A slow, smooth, seemingly aimless turning: each component of its angular velocity is a sum of
/// sines with random frequencies and phases.
class Wander {
 public:
  static constexpr double LOWEST_FREQUENCY = 0.05;   ///< Hz; with the highest: turns of seconds
  static constexpr double HIGHEST_FREQUENCY = 0.30;  ///< Hz

  /// @param rate root mean square of the angular velocity's length [rad/s]
  Wander(double rate, std::mt19937_64& generator);

  /// Angular velocity in the world frame [rad/s].
  Vec3 angular_velocity(double time) const;

  /// Rotation reached at count times 0, time_step, 2 time_step, ..., starting from `start`.
  std::vector<Eigen::Quaterniond> rotations(const Eigen::Quaterniond& start, double time_step,
                                            std::size_t count) const;

 private:
  struct Sine {
    double amplitude;
    double frequency;
    double phase;
  };
  std::array<std::array<Sine, 3>, 3> sines_;  ///< three for each axis
};

}  // namespace lmdbench
