// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <numbers>

/// Sines for generated shapes: their last bits depend on the processor's instruction set, so they are rounded to
/// multiples of 2^-30.
namespace lmdbench {

/// Nearest multiple of 2^-30.
inline double rounded_to_grid(double value) {
  return std::ldexp(std::round(std::ldexp(value, 30)), -30);
}

/// Point i of n on the unit circle, counted round it.
inline std::array<double, 2> circle_point(int i, int n) {
  const double angle = 2.0 * std::numbers::pi * (i % n) / n;
  return {rounded_to_grid(std::cos(angle)), rounded_to_grid(std::sin(angle))};
}

}  // namespace lmdbench
