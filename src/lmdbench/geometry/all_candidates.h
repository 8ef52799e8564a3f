// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/types.h>

namespace lmdbench::kernel {

/// triangle_distance by examining every pair of features: for every finite input, and six
/// times slower than prove_by_features.
/// @param tolerance coincidence_length of the largest coordinate, which is 0 or in [2^-100, 2^100]
TrianglePairDistance distance_by_all_candidates(const Triangle& a, const Triangle& b, double tolerance);

}  // namespace lmdbench::kernel
