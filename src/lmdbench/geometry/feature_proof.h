// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/types.h>

namespace lmdbench::kernel {

/// Nearest pair of two triangles where it is unique by a clear margin, found from a guess of the
/// features that carry it and proved by the signs of a few dot products. What it gives is bit for bit what
/// the examination of all candidates gives.
/// @param tolerance coincidence_length of the largest coordinate, which is in [2^-100, 2^100] or not finite
/// @returns false, with `result` untouched, where nothing was proved: contact, parallel features, exact ties,
///   degenerate triangles, coordinates that are not finite
bool prove_by_features(const Triangle& a, const Triangle& b, double tolerance, TrianglePairDistance& result);

}  // namespace lmdbench::kernel
