// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <string>
#include <string_view>

namespace lmdbench {

/// Reads an OBJ text's surface (lines "v" and "f"), for builds without assimp. Rounds coordinates
/// to single precision like assimp: both builds agree. Polygons become fans round their first
/// corner. Refuses polygons that are not convex (a fan would fold), free-form surfaces, continued
/// lines. Skips all else: points, lines, groups, materials, normals, texture coordinates.
/// @param file its name, for messages
/// @throws InputError naming the line
TriangleMesh parse_obj(std::string_view text, const std::string& file);

}  // namespace lmdbench
