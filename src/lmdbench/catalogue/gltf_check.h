// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace lmdbench {

/// Refuses a glTF file that requires an extension which changes its geometry and is not read:
/// assimp (5.2.5) passes over the list, so that compressed numbers become other places.
/// @param bytes  of a .gltf (JSON) or .glb (binary) file; what is no JSON is left to assimp
/// @param file   its name, for messages
/// @throws InputError naming the extension
void check_gltf(std::string_view bytes, const std::string& file);

}  // namespace lmdbench
