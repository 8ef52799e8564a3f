// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <string>
#include <string_view>

namespace lmdbench {

/// Reads the surface of an OBJ text: the lines "v" and "f", for builds without assimp. Coordinates are rounded to single
/// precision, as assimp reads them, so that both builds answer alike. Polygons become fans round their first corner; one
/// that is not convex, which a fan would fold over, is refused, as are free-form surfaces and lines that are continued.
/// Points, lines, groups, materials, normals and texture coordinates are no part of the surface.
/// @param file its name, for messages
/// @throws InputError naming the line
TriangleMesh parse_obj(std::string_view text, const std::string& file);

}  // namespace lmdbench
