// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <string>

namespace lmdbench {

/// Refuses meshes with neighbourhoods of no surface: k triangles round one edge are k^2 pairs of
/// neighbours. Linear in the mesh.
/// @param file  its name, for messages
/// @throws InputError above `Limit::TRIANGLES`, at an edge above `Limit::EDGE_TRIANGLES`, at a
///   vertex above `Limit::VERTEX_TRIANGLES`; it names the vertices and one of the triangles
void check_mesh_limits(const TriangleMesh& mesh, const std::string& file);

}  // namespace lmdbench
