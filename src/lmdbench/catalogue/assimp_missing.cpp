// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
// Replaces assimp_reader.cpp in a build without assimp (LMDBENCH_WITH_ASSIMP): OBJ alone.
#include <lmdbench/base/build_info.h>
#include <lmdbench/catalogue/assimp_reader.h>
#include <lmdbench/catalogue/obj_file.h>

#include <array>

namespace lmdbench {

std::span<const std::string_view> assimp_extensions() {
  static constexpr std::array<std::string_view, 5> EXTENSIONS{"ply", "stl", "obj", "gltf", "glb"};
  return EXTENSIONS;
}

TriangleMesh read_with_assimp(std::string_view bytes, std::string_view extension, const std::string& file) {
  if (extension == "obj") return parse_obj(bytes, file);
  throw missing_part(PART_ASSIMP, file, "", "a mesh in a format other than OFF and OBJ");
}

}  // namespace lmdbench
