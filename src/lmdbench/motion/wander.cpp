// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/motion/rotation_vector.h>
#include <lmdbench/motion/wander.h>

#include <cmath>
#include <numbers>

namespace lmdbench {

Eigen::Quaterniond uniform_rotation(std::mt19937_64& generator) {
  const double u = uniform_number(generator);
  const double a = 2.0 * std::numbers::pi * uniform_number(generator);
  const double b = 2.0 * std::numbers::pi * uniform_number(generator);
  return Eigen::Quaterniond(std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
                            std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b))
      .normalized();
}

Wander::Wander(double rate, std::mt19937_64& generator) {
  LMDBENCH_EXPECTS(rate >= 0.0, "a rate that is negative or not a number");
  // Nine sines of amplitude A have the mean square 9 A^2 / 2.
  const double amplitude = rate * std::numbers::sqrt2 / 3.0;
  for (auto& axis : sines_)
    for (Sine& sine : axis) {
      sine.amplitude = amplitude;
      sine.frequency = LOWEST_FREQUENCY + (HIGHEST_FREQUENCY - LOWEST_FREQUENCY) * uniform_number(generator);
      sine.phase = 2.0 * std::numbers::pi * uniform_number(generator);
    }
}

Vec3 Wander::angular_velocity(double time) const {
  Vec3 velocity_W = Vec3::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Sine& sine : sines_[axis])
      velocity_W[static_cast<Eigen::Index>(axis)] +=
          sine.amplitude * std::sin(2.0 * std::numbers::pi * sine.frequency * time + sine.phase);
  return velocity_W;
}

std::vector<Eigen::Quaterniond> Wander::rotations(const Eigen::Quaterniond& start, double time_step,
                                                  std::size_t count) const {
  LMDBENCH_EXPECTS(time_step > 0.0, "a rate in place of a period, or no rate");
  std::vector<Eigen::Quaterniond> rotations;
  rotations.reserve(count);
  Eigen::Quaterniond rotation = start.normalized();
  for (std::size_t i = 0; i < count; ++i) {
    rotations.push_back(rotation);
    const double middle = (static_cast<double>(i) + 0.5) * time_step;
    rotation = (rotation_of(time_step * angular_velocity(middle)) * rotation).normalized();
  }
  return rotations;
}

}  // namespace lmdbench
