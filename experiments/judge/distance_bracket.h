// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

namespace lmdbench::testing {

/// Proved bounds of a distance: low <= distance <= high.
struct DistanceBracket {
  long double low = 0.0L;
  long double high = 0.0L;
  int bits = 64;  ///< Precision that closed it: 64 or 113; 0 for rational arithmetic.
};

/// Widest bracket, relative to the pair's largest coordinate: a twentieth of a double's rounding.
inline constexpr long double BRACKET_WIDTH = 2e-17L;

/// The proved distance of two triangles, to BRACKET_WIDTH of their largest coordinate. A pair of
/// feasible points bounds it from above, the gap along a direction from below, both with their
/// roundings. Any points and direction give true bounds, so no error of a search can make one
/// false. 64 bits are tried first, then 113, then exact_distance. Shares nothing with the kernels.
/// @pre finite coordinates, the largest between 2^-1000 and 2^1000
DistanceBracket distance_bracket(const Triangle& a, const Triangle& b);

/// Whether two triangles share a point, by exact predicates.
bool exactly_touch(const Triangle& a, const Triangle& b);

}  // namespace lmdbench::testing
