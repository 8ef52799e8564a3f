// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>

#include <array>
#include <cmath>

namespace lmdbench {

/// Exact number: an unevaluated sum of doubles that do not overlap, smallest first (T. J. Dekker
/// 1971; J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates", 1997). Sums and products are exact unless a partial product underflows or
/// overflows. `Capacity` bounds the number of terms. Written for clarity, not for speed: it is used
/// only where a rounding error bound cannot decide a sign.
template <int Capacity>
struct Expansion {
  std::array<double, Capacity> terms;
  int size = 0;

  /// Adds one double: Shewchuk's GROW-EXPANSION with elimination of zero terms.
  void add(double value) {
    LMDBENCH_EXPECTS(size < Capacity || value == 0.0,
                     "more terms than the type of the result was given room for");
    double carry = value;
    int kept = 0;
    for (int i = 0; i < size; ++i) {
      // Two-sum: high + low == carry + terms[i] exactly.
      const double high = carry + terms[i];
      const double virtual_part = high - carry;
      const double low = (carry - (high - virtual_part)) + (terms[i] - virtual_part);
      if (low != 0.0) terms[kept++] = low;
      carry = high;
    }
    if (carry != 0.0) terms[kept++] = carry;
    size = kept;
  }

  /// The largest term dominates the sum of all others, so it carries the sign.
  int sign() const { return size == 0 ? 0 : (terms[size - 1] > 0.0 ? 1 : -1); }
};

/// a - b, exact.
inline Expansion<2> exact_difference(double a, double b) {
  Expansion<2> result;
  result.add(a);
  result.add(-b);
  return result;
}

template <int N, int M>
Expansion<N + M> operator+(const Expansion<N>& a, const Expansion<M>& b) {
  Expansion<N + M> result;
  for (int i = 0; i < a.size; ++i) result.add(a.terms[i]);
  for (int i = 0; i < b.size; ++i) result.add(b.terms[i]);
  return result;
}

template <int N>
Expansion<N> operator-(const Expansion<N>& a) {
  Expansion<N> result = a;
  for (int i = 0; i < a.size; ++i) result.terms[i] = -a.terms[i];
  return result;
}

template <int N, int M>
Expansion<N + M> operator-(const Expansion<N>& a, const Expansion<M>& b) {
  return a + (-b);
}

template <int N, int M>
Expansion<2 * N * M> operator*(const Expansion<N>& a, const Expansion<M>& b) {
  Expansion<2 * N * M> result;
  for (int i = 0; i < a.size; ++i) {
    for (int j = 0; j < b.size; ++j) {
      // fma gives the rounding error of the product exactly.
      const double high = a.terms[i] * b.terms[j];
      result.add(std::fma(a.terms[i], b.terms[j], -high));
      result.add(high);
    }
  }
  return result;
}

}  // namespace lmdbench
