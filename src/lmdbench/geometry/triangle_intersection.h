// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/types.h>

#include <optional>

namespace lmdbench {

/// True exactly when the closed triangles share a point. Decided by the signs of exact orientation
/// predicates, for touching, coplanar and degenerate triangles too. Coordinates below 2^-200 of the largest
/// are taken as 0, because the low bits of their triple products would underflow.
/// @pre finite coordinates, the largest of them 0 or in [2^-100, 2^100]
bool triangles_intersect(const Triangle& a, const Triangle& b);

/// The segment that two intersecting triangles of different planes share: one piece of an intersection
/// polyline, in double precision, ends in lexicographic order; both ends equal where they touch in one point.
/// Empty when the triangles are disjoint, coplanar, or degenerate.
std::optional<Segment> intersection_segment(const Triangle& a, const Triangle& b);

}  // namespace lmdbench
