// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/assimp_reader.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/catalogue/mesh_limits.h>
#include <lmdbench/catalogue/obj_file.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/ply_file.h>
#include <lmdbench/catalogue/stl_file.h>
#include <lmdbench/mesh/placement.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace lmdbench {

namespace {

// Lower-case, without the dot.
std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

TriangleMesh read_format(const FileContent& content) {
  const std::string file = content.file.string();
  const std::string extension = extension_of(content.file);
  const std::string_view text = without_byte_order_mark(content.bytes);  // if it is text
  if (extension == "off") return parse_off(text, file);
  if (extension == "obj") return parse_obj(text, file);
  if (extension == "ply") return parse_ply(text, file);
  if (extension == "stl") return parse_stl(content.bytes, file);
  if (std::ranges::find(ASSIMP_EXTENSIONS, extension) == ASSIMP_EXTENSIONS.end())
    throw InputError(file, "", fmt::format("'{}' is no extension of a mesh format that is read", extension),
                     fmt::format("convert it to OFF, PLY, OBJ or STL (extensions off, obj, ply, stl, {})",
                                 fmt::join(ASSIMP_EXTENSIONS, ", ")));
  return read_with_assimp(content.bytes, extension, file);
}

std::array<double, 3> position_key(const Vec3& p) {
  return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
}

}  // namespace

TriangleMesh welded(const TriangleMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(position_key(mesh.vertices[a]), a) < std::pair(position_key(mesh.vertices[b]), b);
  });
  std::vector<std::size_t> first(count);  // first vertex at the same position
  for (std::size_t i = 0; i < count; ++i) {
    const bool same =
        i > 0 && position_key(mesh.vertices[order[i]]) == position_key(mesh.vertices[order[i - 1]]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  std::vector<bool> used(count, false);
  for (const auto& corners : mesh.triangles)
    for (const std::int32_t corner : corners) used[first[static_cast<std::size_t>(corner)]] = true;

  TriangleMesh result;
  std::vector<std::int32_t> number(count, -1);
  for (std::size_t v = 0; v < count; ++v) {
    if (!used[v]) continue;
    number[v] = static_cast<std::int32_t>(result.vertices.size());
    result.vertices.push_back(mesh.vertices[v]);
  }
  result.triangles = mesh.triangles;
  for (auto& corners : result.triangles)
    for (std::int32_t& corner : corners) corner = number[first[static_cast<std::size_t>(corner)]];
  return result;
}

TriangleMesh import_mesh(const std::filesystem::path& file) {
  return import_mesh(read_mesh_file(file));
}

FileContent read_mesh_file(const std::filesystem::path& file) {
  return read_input_file(file, {.what = "mesh file"});
}

TriangleMesh import_unwelded(const FileContent& content) {
  TriangleMesh mesh = read_format(content);
  if (mesh.triangles.empty())
    throw InputError(
        content.file.string(), "", "holds no triangle",
        "name a mesh: point clouds and lines have no surface; text is read with line feeds, in UTF-8");
  return mesh;
}

TriangleMesh import_mesh(const FileContent& content) {
  const std::string file = content.file.string();
  TriangleMesh result = welded(import_unwelded(content));
  refuse_extreme_size(result, file);
  check_mesh_limits(result, file);
  return result;
}

}  // namespace lmdbench
