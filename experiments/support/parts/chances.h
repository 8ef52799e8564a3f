// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <support/random.h>

#include <cmath>
#include <numbers>

/// Random draws of scenes: lengths in metres, angles in radians.
namespace lmdbench::parts {

/// [m]; the parts are about 1 m large.
inline constexpr double CUTOFF = 0.04;

inline constexpr double TAU = 2.0 * std::numbers::pi;

inline bool chance(double probability, experiments::Random& random) {
  return random.uniform() < probability;
}

/// The nearest multiple of 2^-bits.
inline double dyadic(double x, int bits) {
  return std::ldexp(std::round(std::ldexp(x, bits)), -bits);
}

/// 10^U(low, high).
inline double power_of_ten(double low, double high, experiments::Random& random) {
  return std::pow(10.0, random.uniform(low, high));
}

/// The same, of either sign.
inline double decades(double low, double high, experiments::Random& random) {
  const double size = power_of_ten(low, high, random);
  return chance(0.5, random) ? size : -size;
}

/// 0, or a tiny number with probability `share`.
inline double tiny(double share, double low, double high, experiments::Random& random) {
  return chance(share, random) ? decades(low, high, random) : 0.0;
}

/// From overlap over touch to the cutoff.
inline double draw_gap(experiments::Random& random) {
  const double kind = random.uniform();
  if (kind < 0.08) return 0.0;
  if (kind < 0.16) return -std::pow(10.0, random.uniform(-9.0, -2.0));
  if (kind < 0.6) return CUTOFF * std::pow(10.0, random.uniform(-9.0, 0.0));
  return CUTOFF * random.uniform();
}

}  // namespace lmdbench::parts
