// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>
#include <judge/exact_distance.h>

#include <cmath>

namespace lmdbench::testing {
namespace {

using Exact = CGAL::Simple_cartesian<CGAL::Gmpq>;

Exact::Point_3 exact(const Vec3& p) {
  return {CGAL::Gmpq(p[0]), CGAL::Gmpq(p[1]), CGAL::Gmpq(p[2])};
}

Exact::Triangle_3 exact(const Triangle& t) {
  return {exact(t[0]), exact(t[1]), exact(t[2])};
}

/// Square root of a rational. Scaled to near 1 first, because the square of a small
/// distance may be a denormal.
double root(const CGAL::Gmpq& squared) {
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

}  // namespace

double exact_distance(const Triangle& a, const Triangle& b) {
  return root(CGAL::squared_distance(exact(a), exact(b)));
}

double exact_distance(const Vec3& point, const Triangle& triangle) {
  // As a triangle of three equal corners: the point-triangle overload needs a plane,
  // which a flat triangle has not.
  const Vec3& p = point;
  return exact_distance(Triangle{p, p, p}, triangle);
}

}  // namespace lmdbench::testing
