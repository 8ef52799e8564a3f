// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/types.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace lmdbench {

/// A length below this part of the largest coordinate is rounding: points that close coincide, and
/// edges or faces that drift apart by less are parallel. A corner that went through a rigid
/// transform carries about four roundings per coordinate and an edge has two such corners, so
/// sixteen epsilons cover the effect of a common rotation on two parallel edges. Taking them as
/// parallel changes a distance by less than 1e-14 of the coordinates.
inline constexpr double COINCIDENCE_TOLERANCE = 16.0 * std::numeric_limits<double>::epsilon();

/// Readers of files refuse larger coordinates: hierarchies square distances in single precision,
/// which ends at 3.4e38 (the sum of two meshes' diagonals squared is 4.8e37 here).
inline constexpr double LARGEST_COORDINATE = 1e18;

/// Readers refuse meshes with a smaller diagonal of the bounding box: squares of their smallest
/// parts would vanish there.
inline constexpr double SMALLEST_DIAGONAL = 1e-15;

/// Largest absolute coordinate; a coordinate that is not a number does not count, see all_finite.
inline double largest_coordinate(std::span<const Vec3> points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double), "the coordinates of several points lie side by side");
  using Two = Eigen::Array2d;
  if (points.empty()) return 0.0;
  const double* coordinate = points.front().data();
  const double* const end = coordinate + 3 * points.size();
  // Two running maxima of two: short chains that the processor overlaps.
  Two first = Two::Zero(), second = Two::Zero();
  for (; end - coordinate >= 4; coordinate += 4) {
    first = first.max(Eigen::Map<const Two>(coordinate).abs());
    second = second.max(Eigen::Map<const Two>(coordinate + 2).abs());
  }
  first = first.max(second);
  double result = std::max(first[0], first[1]);
  for (; coordinate != end; ++coordinate) result = std::max(result, std::abs(*coordinate));
  return result;
}

inline bool all_finite(std::span<const Vec3> points) {
  return std::all_of(points.begin(), points.end(), [](const Vec3& point) { return point.allFinite(); });
}

/// COINCIDENCE_TOLERANCE times the coordinate magnitude rounded down to a power of two, so that
/// calls which share features but not all corners nearly always decide by the same length.
/// @param magnitude not negative; a denormal one gives 0
inline double coincidence_length(double magnitude) {
  LMDBENCH_EXPECTS(!(magnitude < 0.0), "a coordinate in place of its magnitude");
  constexpr std::uint64_t EXPONENT_BITS = 0x7FF0000000000000U;
  return COINCIDENCE_TOLERANCE *
         std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) & EXPONENT_BITS);
}

/// Lexicographic order of coordinates: the canonical order of corners. Without branches, because
/// the branch predictor could only guess the outcome.
inline bool lexicographic_less(const Vec3& a, const Vec3& b) {
  const bool less_0 = a[0] < b[0], equal_0 = a[0] == b[0];
  const bool less_1 = a[1] < b[1], equal_1 = a[1] == b[1];
  const bool less_2 = a[2] < b[2];
  return less_0 | (equal_0 & (less_1 | (equal_1 & less_2)));
}

}  // namespace lmdbench
