// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <string>
#include <string_view>

namespace lmdbench {

/// Reads a PLY file, text or binary, by its header: elements `vertex`, `face` and `tristrips`;
/// others and further properties are passed over. Coordinates have the precision that the header
/// names. Own code, because assimp (5.2.5) takes other elements for vertices and faces, reads of a
/// strip the first triangle alone, cuts polygons that are not convex outside of themselves and
/// loops on a truncated header.
/// @param bytes  the whole file
/// @param file   its name, for messages
/// @return vertices in the file's order, those without triangles too
/// @throws InputError naming the line or the element; also where the file ends before or goes on
///   behind what its header announces, and above a limit
TriangleMesh parse_ply(std::string_view bytes, const std::string& file);

}  // namespace lmdbench
