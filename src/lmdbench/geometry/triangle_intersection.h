// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/types.h>

namespace lmdbench {

/// True exactly when the closed triangles share a point. Decided by the signs of exact orientation
/// predicates, for touching, coplanar and degenerate triangles too. Coordinates below 2^-200 of the largest
/// are taken as 0, because the low bits of their triple products would underflow.
/// @pre finite coordinates, the largest of them 0 or in [2^-100, 2^100]
bool triangles_intersect(const Triangle& a, const Triangle& b);

/// Which of two bodies a segment is of; the triangle is of the other one.
enum class PiercingBody : int {
  DISPLACED = 1,  ///< By (e, e^2, e^3) for a positive e below every other length.
  RESTING = -1
};

/// Whether a segment pierces a triangle, once one of the bodies is displaced by an infinitely small step in a
/// fixed direction. Exact, and never a matter of touching: of what touches, the step makes crossing or apart, the
/// same for all segments and triangles of the two bodies ("simulation of simplicity", H. Edelsbrunner and E. P.
/// Muecke 1990, with one perturbation for a whole body). So the piercings of two closed surfaces fit together: a
/// pair of triangles has none or two, and an edge pierces one of the triangles round the place where it comes
/// through. Decided by signs of orientation_3d; where one is 0, by its derivative along the step.
/// A triangle without area is never pierced.
/// @pre as triangles_intersect
bool pierces(const Segment& segment, PiercingBody body, const Triangle& triangle);

/// Where the segment comes through the triangle's plane: on the segment, and on the plane up to rounding.
/// @pre pierces(segment, ..., triangle)
Vec3 piercing_point(const Segment& segment, const Triangle& triangle);

}  // namespace lmdbench
