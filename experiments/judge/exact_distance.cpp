// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>
#include <judge/exact_distance.h>
#include <judge/exact_root.h>

namespace lmdbench::testing {
namespace {

using Exact = CGAL::Simple_cartesian<CGAL::Gmpq>;

Exact::Point_3 exact(const Vec3& p) {
  return {CGAL::Gmpq(p[0]), CGAL::Gmpq(p[1]), CGAL::Gmpq(p[2])};
}

Exact::Triangle_3 exact(const Triangle& t) {
  return {exact(t[0]), exact(t[1]), exact(t[2])};
}

}  // namespace

double exact_distance(const Triangle& a, const Triangle& b) {
  return exact::rounded_root(CGAL::squared_distance(exact(a), exact(b)));
}

double exact_distance(const Vec3& point, const Triangle& triangle) {
  // The point is a triangle of three equal corners: CGAL's point-triangle overload needs a plane,
  // which a flat triangle lacks.
  const Vec3& p = point;
  return exact_distance(Triangle{p, p, p}, triangle);
}

}  // namespace lmdbench::testing
