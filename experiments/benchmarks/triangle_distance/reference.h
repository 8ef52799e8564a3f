// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

namespace lmdbench::experiments {

/// Distance of two triangles by a way that shares nothing with any implementation: the distance of the origin
/// from the polytope of the nine corner differences, as the least over the hulls of all its point pairs and
/// triples; 0 when one of its tetrahedra holds the origin. Slow. Good to about 1e-9 of the triangles' size
/// for triangles that are not nearly degenerate, which is what the benchmark's pairs are.
double reference_triangle_distance(const Triangle& a, const Triangle& b);

}  // namespace lmdbench::experiments
