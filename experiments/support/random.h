// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/statistics.h>
#include <lmdbench/geometry/types.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace lmdbench::experiments {

/// Random numbers, the same with every standard library and processor. The engine is specified to
/// the bit; the standard's distributions are not, and sines differ with the instruction set. So the
/// mappings here use only correctly rounded operations.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1), multiples of 2^-53.
  double uniform() { return uniform_number(engine_); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform in 0 to count - 1.
  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }

  /// Uniform on the unit sphere (Marsaglia 1972).
  Vec3 direction() {
    const DiscPoint p = disc_point();
    const double factor = 2.0 * std::sqrt(1.0 - p.squared_radius);
    return {factor * p.x, factor * p.y, 1.0 - 2.0 * p.squared_radius};
  }

  /// Uniform over all rotations (Marsaglia 1972).
  Eigen::Quaterniond rotation() {
    const DiscPoint p = disc_point();
    const DiscPoint q = disc_point();
    const double factor = std::sqrt((1.0 - p.squared_radius) / q.squared_radius);
    return Eigen::Quaterniond(p.x, p.y, factor * q.x, factor * q.y).normalized();
  }

 private:
  struct DiscPoint {
    double x, y, squared_radius;
  };

  /// Uniform in the unit disc without its centre, by rejection.
  DiscPoint disc_point() {
    for (;;) {
      const double x = uniform(-1.0, 1.0);
      const double y = uniform(-1.0, 1.0);
      const double squared_radius = x * x + y * y;
      if (squared_radius < 1.0 && squared_radius > 0.0) return {x, y, squared_radius};
    }
  }

  std::mt19937_64 engine_;
};

}  // namespace lmdbench::experiments
