// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>

namespace lmdbench {

/// Flips the longest side of each flat triangle whose third corner lies on that side: meshers close
/// a T junction so. Flat is one without area (ZERO_AREA_TOLERANCE), or not higher than `height`.
/// The triangle beyond the side is cut at the corner, and both keep their numbers. The surface
/// stays where it is, to that height; without the flip the faces on either side of the junction
/// would end at it, each with an edge of its own, and rounding may turn the triangle over.
///
/// Not flipped: a side that has not two triangles, one in each direction, and one whose flip would
/// make an edge that is there already or turn a triangle over.
/// @param height in the mesh's unit
/// @return how many were flipped
std::int64_t flip_flat_triangles(TriangleMesh& mesh, double height = 0.0);

}  // namespace lmdbench
