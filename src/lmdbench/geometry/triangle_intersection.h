// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/types.h>

namespace lmdbench {

/// True exactly when the closed triangles share a point. The signs of exact orientation predicates
/// decide, for touching, coplanar and degenerate triangles too. Coordinates below 2^-200 of the
/// largest count as 0, because the low bits of their triple products would underflow.
/// @pre finite coordinates, the largest of them 0 or in [2^-100, 2^100]
bool triangles_intersect(const Triangle& a, const Triangle& b);

/// The body that a segment belongs to; the triangle belongs to the other one.
enum class PiercingBody : int {
  DISPLACED = 1,  ///< By (e, e^2, e^3) for a positive e below every other length.
  RESTING = -1
};

/// Whether a segment pierces a triangle after an infinitely small displacement of one of the bodies
/// in a fixed direction. Exact, and touching is no case of its own: the step makes features that
/// touch cross or part, the same way for all segments and triangles of the two bodies ("simulation
/// of simplicity", H. Edelsbrunner and E. P. Muecke 1990, with one perturbation for a whole body).
/// So the piercings of two closed surfaces fit together: a pair of triangles has none or two, and
/// an edge pierces one of the triangles round the point where it passes. Signs of orientation_3d
/// decide; where one is 0, its derivative along the step. A triangle without area is never pierced.
/// @pre as triangles_intersect
bool pierces(const Segment& segment, PiercingBody body, const Triangle& triangle);

/// Where the segment passes the triangle's plane: on the segment, on the plane up to rounding.
/// @pre pierces(segment, ..., triangle)
Vec3 piercing_point(const Segment& segment, const Triangle& triangle);

}  // namespace lmdbench
