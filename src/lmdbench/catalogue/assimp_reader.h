// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <array>
#include <string>
#include <string_view>

namespace lmdbench {

/// Extensions of the format read through assimp, lower-case: glTF 2. Its fifty other readers are
/// not used: they guess at damaged files, and several loop or crash on them.
inline constexpr std::array<std::string_view, 2> ASSIMP_EXTENSIONS{"gltf", "glb"};

/// Reads a mesh through assimp in a child process of limited time and memory
/// (`Limit::IMPORT_SECONDS`, `Limit::IMPORT_BYTES`), because assimp may loop or crash on damaged
/// files. Opens no file that it refers to (buffers, textures). One import at a time.
/// @param bytes      the whole file
/// @param extension  one of `ASSIMP_EXTENSIONS`
/// @param file       its name, for messages
/// @return all meshes of the file, merged; not welded
/// @throws InputError when the file is damaged or the child ends without an answer
TriangleMesh read_with_assimp(std::string_view bytes, std::string_view extension, const std::string& file);

}  // namespace lmdbench
