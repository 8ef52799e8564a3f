// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lmdbench {

/// Refuses a glTF file of which assimp (5.2.5) makes another mesh without a word: one that requires
/// an extension which changes its geometry, skins and weights of morph targets, sparse accessors
/// over interleaved numbers or with fewer ones than they say, numbers of kinds that glTF has not,
/// members of another kind than glTF says (assimp takes their default), text that is not base64.
/// @param bytes  of a .gltf (JSON) or .glb (binary) file; what is damaged is left to assimp
/// @param file   its name, for messages
/// @return triangles of the meshes of the scene that it shows, as their accessors promise
/// @throws InputError naming the extension or the place as a JSON pointer
std::int64_t check_gltf(std::string_view bytes, const std::string& file);

}  // namespace lmdbench
