// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace lmdbench {

/// Reads an OFF text file line by line, in double precision. Own code, because assimp (5.2.5) reads
/// OFF in single precision, takes a negative index for 0, clamps indices that are out of range and
/// aborts the program on a truncated file. Polygons are cut into triangles
/// (`add_polygon`). Further columns (normals, colours, texture coordinates) are ignored.
/// @throws InputError naming the line; also for binary OFF and above a limit
TriangleMesh read_off(const std::filesystem::path& file);

/// The same from text; `file` is its name in messages.
TriangleMesh parse_off(std::string_view text, const std::string& file);

/// OFF text with the shortest decimals that read back to the same bits.
std::string to_off_text(const TriangleMesh& mesh);

/// Writes `to_off_text` atomically: the file has its old content or the whole new one.
/// @throws EnvironmentError when the file cannot be written
void write_off(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace lmdbench
