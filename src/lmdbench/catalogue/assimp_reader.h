// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace lmdbench {

/// Extensions of the format read through assimp, lower-case: glTF 2. Its fifty other readers are
/// not used: they guess at damaged files, and several loop or crash on them.
std::span<const std::string_view> assimp_extensions();

/// Reads a mesh through assimp in a child process of limited time and memory
/// (`Limit::IMPORT_SECONDS`, `Limit::IMPORT_BYTES`), because assimp may loop or crash on damaged
/// files. Opens no file that it refers to (buffers, textures). One import at a time.
/// @param bytes      the whole file
/// @param extension  one of `assimp_extensions`
/// @param file       its name, for messages
/// @param triangles  of all meshes of the file, as it promises: assimp drops those that name
///   vertices which are not there
/// @return all meshes of the file, merged; not welded
/// @throws InputError when the file is damaged or the child ends without an answer
TriangleMesh read_with_assimp(std::string_view bytes, std::string_view extension, const std::string& file,
                              std::int64_t triangles);

}  // namespace lmdbench
