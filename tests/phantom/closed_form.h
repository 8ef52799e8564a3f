// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace lmdbench {

/// Closed form without hand and delay, where the pair of complex eigenvalues reaches the circle
/// before a real one reaches -1: K = b^2 (1 - a) / (m (1 - a - a b T / m)), a = e^(-b T / m). The
/// other is at K = 2 b^2 (1 + a) / (b T (1 + a) - 2 m (1 - a)); the lesser is the boundary.
inline double critical_stiffness_without_delay(double mass_kg, double damping_n_s_per_m, double period_s) {
  const double b = damping_n_s_per_m;
  const double x = b * period_s / mass_kg;
  const double one_minus_a = -std::expm1(-x);
  // 1 - a - a x = e^-x (e^x - 1 - x) loses its digits for weak damping: there the series of e^x.
  double remainder = 0.0;
  if (x < 0.5) {
    double term = x * x / 2.0;
    for (int n = 3; term > remainder * std::numeric_limits<double>::epsilon() * 0.25; ++n) {
      remainder += term;
      term *= x / n;
    }
  } else {
    remainder = std::expm1(x) - x;
  }
  const double complex_pair = b * b * one_minus_a / (mass_kg * std::exp(-x) * remainder);
  const double a = std::exp(-x);
  const double at_minus_one =
      2.0 * b * b * (1.0 + a) / (b * period_s * (1.0 + a) - 2.0 * mass_kg * one_minus_a);
  // The difference in its denominator is positive, tanh(x/2) < x/2, and vanishes to third order:
  // there is no boundary then.
  return at_minus_one > 0.0 ? std::min(complex_pair, at_minus_one) : complex_pair;
}

}  // namespace lmdbench
