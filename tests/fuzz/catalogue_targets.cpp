// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/import.h>
#include <lmdbench/catalogue/manifest.h>
#include <lmdbench/catalogue/obj_file.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/ply_file.h>
#include <lmdbench/catalogue/shape_recipe.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/validity.h>

#include "promise.h"
#include "targets.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace lmdbench::testing {
namespace {

/// Larger meshes are only timed: building the surface's tables would hide the cost of the reader.
constexpr std::size_t SMALL_MESH = 2000;

std::optional<std::string> broken_mesh_file(const FileContent& content) {
  return broken_unless_refused(content.file.string(), [&]() -> std::string {
    const TriangleMesh mesh = import_mesh(content);
    if (std::string broken = broken_mesh(mesh); !broken.empty()) return broken;
    if (mesh.triangles.empty()) return "a mesh without triangles";
    if (mesh.triangles.size() > SMALL_MESH) return {};
    const ValidityReport report = check_mesh(build_surface(mesh));
    return report.triangles == static_cast<std::int64_t>(mesh.triangles.size()) ? "" : "triangles are lost";
  });
}

}  // namespace

std::optional<std::string> broken_off(std::string_view bytes) {
  const auto broken = broken_unless_refused("fuzz.off", [&]() -> std::string {
    const TriangleMesh mesh = parse_off(bytes, "fuzz.off");
    if (std::string wrong = broken_mesh(mesh); !wrong.empty()) return wrong;
    return same_mesh(parse_off(to_off_text(mesh), "fuzz.off"), mesh) ? "" : "does not read back the same";
  });
  return broken.value_or("").empty() ? broken_mesh_file({"fuzz.off", std::string(bytes), {}}) : broken;
}

std::optional<std::string> broken_ply(std::string_view bytes) {
  return broken_unless_refused(
      "fuzz.ply", [&]() -> std::string { return broken_mesh(welded(parse_ply(bytes, "fuzz.ply"))); });
}

std::optional<std::string> broken_obj(std::string_view bytes) {
  return broken_unless_refused(
      "fuzz.obj", [&]() -> std::string { return broken_mesh(welded(parse_obj(bytes, "fuzz.obj"))); });
}

std::optional<std::string> broken_import(std::string_view bytes) {
  constexpr std::array<const char*, 5> FILES{"fuzz.ply", "fuzz.obj", "fuzz.stl", "fuzz.gltf", "fuzz.glb"};
  static const bool limited = (set_limit("import-seconds=1"), set_limit("import-bytes=1000000000"), true);
  if (bytes.empty() || !limited) return std::nullopt;
  const char* file = FILES[static_cast<unsigned char>(bytes.front()) % FILES.size()];
  return broken_mesh_file({file, std::string(bytes.substr(1)), {}});
}

namespace {

/// Whether a shape has few triangles, or too many to be made: any other number would take long.
bool is_quick_to_make(const nlohmann::json& recipe) {
  for (const auto& [key, value] : recipe.items()) {
    if (value.is_object() && !is_quick_to_make(value)) return false;
    const int most = key == "subdivisions" ? 2 : key == "around" ? 48 : 12;
    if (value.is_number_integer() && value > most && value < 10'000'000) return false;
  }
  return true;
}

}  // namespace

std::optional<std::string> broken_manifest(std::string_view bytes) {
  return broken_unless_refused("fuzz/manifest.json", [&]() -> std::string {
    const Manifest read = parse_manifest(std::string(bytes), "fuzz/manifest.json");
    for (const ManifestEntry& entry : read.entries) {
      if (read.built_file(entry).parent_path() != "fuzz") return "a mesh outside of the manifest's folder";
      if (entry.source.has_value() == entry.shape.has_value()) return "neither source nor shape, or both";
      if (!entry.shape || !is_quick_to_make(*entry.shape)) continue;
      const TriangleMesh mesh = make_shape(*entry.shape, "fuzz/manifest.json", "/meshes/shape");
      if (std::string broken = broken_mesh(mesh); !broken.empty()) return broken;
    }
    return {};
  });
}

}  // namespace lmdbench::testing
