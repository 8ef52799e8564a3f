// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <string>
#include <string_view>

namespace lmdbench {

/// Reads an OBJ text's surface (lines "v" and "f"), in single precision. Own code, because assimp
/// (5.2.5) cuts polygons that are not convex outside of themselves, drops or cuts lines that are
/// damaged and takes more than linear time for long ones. Skips all else: points, lines, groups,
/// materials, normals, texture coordinates, a vertex's weight (which is for free-form curves) or
/// colour; refuses free-form curves and surfaces.
/// @param file its name, for messages
/// @return vertices in the file's order, those without triangles too
/// @throws InputError naming the line
TriangleMesh parse_obj(std::string_view text, const std::string& file);

}  // namespace lmdbench
