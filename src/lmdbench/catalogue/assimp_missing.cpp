// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
// Replaces assimp_reader.cpp in a build without assimp (LMDBENCH_WITH_ASSIMP).
#include <lmdbench/base/build_info.h>
#include <lmdbench/catalogue/assimp_reader.h>

namespace lmdbench {

TriangleMesh read_with_assimp(std::string_view /*bytes*/, std::string_view /*extension*/,
                              const std::string& file) {
  throw missing_part(PART_ASSIMP, file, "", "a mesh in a format other than OFF, OBJ, PLY and STL");
}

}  // namespace lmdbench
