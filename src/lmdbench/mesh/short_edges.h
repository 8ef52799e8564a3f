// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>

namespace lmdbench {

/// Brings the ends of edges no longer than `length` to one vertex, which collapses the triangles
/// beside them (`names_vertex_twice`). Of those that become one the vertex stays that is first by
/// its coordinates; no coordinate changes, and all keep their numbers. (Rounding the result of an
/// exact Boolean operation to doubles leaves edges of a few units in the last place, and between
/// them walls of that height, too low to tell where their surface leads down.)
/// @param length in the mesh's unit
/// @return how many triangles collapsed
std::int64_t collapse_short_edges(TriangleMesh& mesh, double length);

}  // namespace lmdbench
