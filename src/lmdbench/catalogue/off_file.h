// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <filesystem>
#include <optional>
#include <string>

namespace lmdbench {

/// Reads an OFF text file line by line, in double precision. Own code although assimp reads OFF too, because
/// assimp reads it in single precision, takes a negative index for 0, clamps indices that are out of range
/// and aborts the program on a file that was cut short (5.2.5). Polygons with more than three corners become
/// fans round their first corner. Further columns (colours) are ignored.
/// @return nothing for the variants with another keyword (COFF, NOFF, ...) or binary data
/// @throws InputError naming the line
std::optional<TriangleMesh> read_off(const std::filesystem::path& file);

/// OFF text with the shortest decimals that read back to the same bits.
std::string to_off_text(const TriangleMesh& mesh);

/// Writes `to_off_text` atomically: the file has its old content or the whole new one.
/// @throws EnvironmentError when the file cannot be written
void write_off(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace lmdbench
