// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangle_3.h>
#include <CGAL/intersections.h>
#include <judge/distance_bracket.h>
#include <judge/exact_distance.h>
#include <judge/witness_search.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace lmdbench::testing {
namespace {

__extension__ using Real113 = __float128;

/// Half a unit in the last place of 1.
template <class Real>
constexpr long double ROUNDING = 0x1p-64L;
template <>
constexpr long double ROUNDING<Real113> = 0x1p-113L;
static_assert(std::numeric_limits<long double>::digits >= 64);

/// Roundings of the largest coordinate m in the length of a vector between two weighted points.
/// Corners relative to the origin are up to 2 sqrt(3) m long with one rounding, products with
/// weights and their sums three more, the weights' own sum two, at either end; the length adds
/// four. 2 * 6 * 3.5 + 4 * 3.5 < 64.
constexpr long double ROUNDINGS_OF_LENGTH = 64.0L;
/// The same of a corner's difference along a unit direction: one in the difference of two relative
/// corners after one in each, four in product and sums, four in length and division; 3.5 each.
constexpr long double ROUNDINGS_ALONG = 64.0L;
/// The 113-bit type is rounded to a long double at the end.
constexpr long double LAST_ROUNDINGS = 4.0L;

long double magnitude(const Triangle& a, const Triangle& b) {
  double result = 0.0;
  for (const Triangle* t : {&a, &b}) {
    for (const Vec3& p : *t) result = std::max(result, p.cwiseAbs().maxCoeff());
  }
  return result;
}

template <class Real>
WitnessVector<Real> weighted(const std::array<WitnessVector<Real>, 3>& t, const std::array<Real, 3>& w) {
  return w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
}

/// A lower bound of the distance, at least 0: the triangles' gap along any direction.
template <class Real>
Real gap_along(const WitnessSearch<Real>& search, const WitnessVector<Real>& direction) {
  const Real length = root(dot(direction, direction));
  if (!(length > 0)) return 0;
  Real least = 0, greatest = 0;
  bool is_first = true;
  for (const auto& p : search.a) {
    for (const auto& q : search.b) {
      const Real along = dot(q - p, direction);
      least = is_first || along < least ? along : least;
      greatest = is_first || along > greatest ? along : greatest;
      is_first = false;
    }
  }
  const Real gap = least > -greatest ? least : -greatest;
  return gap > 0 ? gap / length : Real(0);
}

/// @returns nothing where the bracket stays too wide
template <class Real>
std::optional<DistanceBracket> bracket(const Triangle& a, const Triangle& b) {
  WitnessSearch<Real> search(a, b);
  const Witness<Real> witness = search.run();
  const auto d = weighted(search.b, witness.on_b) - weighted(search.a, witness.on_a);
  const Real length = root(dot(d, d));
  const Real by_pair = gap_along(search, d), by_normal = gap_along(search, witness.normal);
  const Real gap = by_pair > by_normal ? by_pair : by_normal;
  const long double size = magnitude(a, b);
  const long double last = LAST_ROUNDINGS * ROUNDING<long double> * static_cast<long double>(length);
  DistanceBracket result;
  result.high = static_cast<long double>(length) + ROUNDINGS_OF_LENGTH * ROUNDING<Real> * size + last;
  result.low = static_cast<long double>(gap) - ROUNDINGS_ALONG * ROUNDING<Real> * size - last;
  result.low = std::max(result.low, 0.0L);
  if (!(result.high - result.low <= BRACKET_WIDTH * size)) return std::nullopt;
  return result;
}

using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;

Filtered::Triangle_3 filtered(const Triangle& t) {
  const auto point = [](const Vec3& p) { return Filtered::Point_3(p[0], p[1], p[2]); };
  return {point(t[0]), point(t[1]), point(t[2])};
}

/// Range of the largest coordinate in which no product of three overflows or vanishes.
constexpr long double SMALLEST_FILTERED = 0x1p-250L;
constexpr long double LARGEST_FILTERED = 0x1p+250L;

}  // namespace

DistanceBracket distance_bracket(const Triangle& a, const Triangle& b) {
  if (const auto result = bracket<long double>(a, b)) return *result;
  if (auto result = bracket<Real113>(a, b)) {
    result->bits = 113;
    return *result;
  }
  const long double distance = exact_distance(a, b);
  // One rounding, to a double.
  const long double rounding = distance * std::numeric_limits<double>::epsilon();
  return {distance - rounding, distance + rounding, 0};
}

bool exactly_touch(const Triangle& a, const Triangle& b) {
  const long double size = magnitude(a, b);
  const Filtered::Triangle_3 ta = filtered(a), tb = filtered(b);
  if (size < SMALLEST_FILTERED || size > LARGEST_FILTERED || ta.is_degenerate() || tb.is_degenerate()) {
    return exact_distance(a, b) == 0.0;
  }
  return CGAL::do_intersect(ta, tb);
}

}  // namespace lmdbench::testing
