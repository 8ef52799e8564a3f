// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <string>
#include <string_view>

namespace lmdbench {

/// Reads an STL file, text or binary, in single precision; each triangle has vertices of its own.
/// Normals are passed over. Own code, because assimp (5.2.5) reads numbers of text with errors of
/// up to two units in the last place, and other meshes from damaged files.
/// @param bytes  the whole file
/// @param file   its name, for messages
/// @throws InputError naming the line or facet; also for a file whose length its header denies
TriangleMesh parse_stl(std::string_view bytes, const std::string& file);

}  // namespace lmdbench
