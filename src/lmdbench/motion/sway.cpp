// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/motion/sway.h>

#include <cmath>
#include <random>

namespace lmdbench {
namespace {

/// Uniform over all directions, by rejection.
Vec3 any_direction(std::mt19937_64& random) {
  for (;;) {
    const double x = 2.0 * uniform_number(random) - 1.0, y = 2.0 * uniform_number(random) - 1.0;
    const Vec3 inside(x, y, 2.0 * uniform_number(random) - 1.0);
    const double squared = inside.squaredNorm();
    if (squared > 0.01 && squared <= 1.0) return inside / std::sqrt(squared);
  }
}

}  // namespace

SwayMotion::SwayMotion(const Sway& rule, std::uint64_t which, const Vec3& centre_M, double diagonal)
    : centre_M_(centre_M), period_s_(rule.period_s) {
  LMDBENCH_EXPECTS(rule.period_s > 0.0 && diagonal >= 0.0, "a rule that was not checked (experiment schema)");
  std::mt19937_64 random(rule.seed ^ (0x9e3779b97f4a7c15U * (which + 1)));
  way_ = rule.way_diagonals * diagonal * any_direction(random);
  half_ = 0.5 * rule.turn_rad * any_direction(random);
  phase_ = uniform_number(random);
}

Pose SwayMotion::at(double time) const {
  const double x = time / period_s_ + phase_, part = 2.0 * (x - std::floor(x));
  const double u = part < 1.0 ? part : part - 1.0;
  const double swing = (part < 1.0 ? 4.0 : -4.0) * u * (1.0 - u);
  const Vec3 half = swing * half_;
  Pose pose;
  pose.rotation = Eigen::Quaterniond(1.0, half.x(), half.y(), half.z()).normalized();
  pose.translation = swing * way_ + centre_M_ - pose.rotation * centre_M_;
  return pose;
}

}  // namespace lmdbench
