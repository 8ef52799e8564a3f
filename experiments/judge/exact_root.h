// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CGAL/Gmpq.h>

#include <cmath>

namespace lmdbench::exact {

/// Square root of a rational that is not negative. It is scaled to near 1 first, because the square
/// of a small distance may be a denormal.
inline double rounded_root(const CGAL::Gmpq& squared) {
  if (squared == 0) return 0.0;
  int exponent = static_cast<int>(mpz_sizeinbase(squared.numerator().mpz(), 2)) -
                 static_cast<int>(mpz_sizeinbase(squared.denominator().mpz(), 2));
  exponent -= exponent % 2;
  CGAL::Gmpq scaled = squared;
  if (exponent >= 0) {
    mpq_div_2exp(scaled.mpq(), squared.mpq(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_mul_2exp(scaled.mpq(), squared.mpq(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return std::ldexp(std::sqrt(CGAL::to_double(scaled)), exponent / 2);
}

}  // namespace lmdbench::exact
