// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/gltf_check.h>

#include <boost/endian/conversion.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace lmdbench {
namespace {

/// Of looks alone, or read by assimp (Draco). Endings of names are of versions.
constexpr std::array<std::string_view, 8> HARMLESS{
    "KHR_materials_", "KHR_texture_", "KHR_lights_",    "EXT_texture_",
    "MSFT_texture_",  "KHR_xmp",      "KHR_animation_", "KHR_draco_mesh_compression"};
constexpr std::size_t GLB_HEADER = 12, CHUNK_HEADER = 8;

/// The JSON of either form.
std::string_view json_of(std::string_view bytes) {
  if (!bytes.starts_with("glTF") || bytes.size() < GLB_HEADER + CHUNK_HEADER) return bytes;
  const std::size_t length =
      boost::endian::load_little_u32(reinterpret_cast<const unsigned char*>(bytes.data()) + GLB_HEADER);
  return bytes.substr(GLB_HEADER + CHUNK_HEADER, length);
}

using Json = nlohmann::json;

/// The root without what may be large.
Json root_of(std::string_view bytes) {
  const auto is_kept = [](int depth, Json::parse_event_t event, const Json& parsed) {
    return depth != 1 || event != Json::parse_event_t::key || (parsed != "buffers" && parsed != "images");
  };
  return Json::parse(json_of(bytes), is_kept, false);
}

/// The entries of a list of the root; none where it is damaged, which assimp tells.
std::vector<Json> entries(const Json& root, const char* list) {
  return root.is_object() && root.contains(list) && root[list].is_array()
             ? root[list].get<std::vector<Json>>()
             : std::vector<Json>();
}

/// What an index in an object names in a list; null where there is none.
Json named(const Json& object, const char* key, const std::vector<Json>& list) {
  if (!object.is_object() || !object.contains(key) || !object[key].is_number_unsigned()) return nullptr;
  const auto index = object[key].get<std::size_t>();
  return index < list.size() ? list[index] : Json();
}

bool has_weights(const Json& object) {
  return object.is_object() && object.contains("weights") && object["weights"].is_array() &&
         std::ranges::any_of(object["weights"], [](const Json& weight) { return weight != 0.0; });
}

/// The triangles of a primitive; those of lines and points are none.
std::int64_t triangles_of(const Json& primitive, const std::vector<Json>& accessors) {
  constexpr std::int64_t TRIANGLES = 4, STRIP = 5, FAN = 6;
  if (!primitive.is_object()) return 0;
  const Json attributes = primitive.value("attributes", Json::object());
  const Json of = primitive.contains("indices") ? named(primitive, "indices", accessors)
                                                : named(attributes, "POSITION", accessors);
  const Json count = of.is_object() ? of.value("count", Json()) : Json();
  const Json given = primitive.value("mode", Json(TRIANGLES));
  const std::int64_t mode = given.is_number_integer() ? given.get<std::int64_t>() : TRIANGLES;
  if (!count.is_number_unsigned() || count > limit_of(Limit::TRIANGLES)) return 0;
  const auto corners = count.get<std::int64_t>();
  if (mode == TRIANGLES) return corners / 3;
  return mode == STRIP || mode == FAN ? std::max(corners - 2, std::int64_t{0}) : 0;
}

}  // namespace

std::int64_t check_gltf(std::string_view bytes, const std::string& file) {
  const Json root = root_of(bytes);
  const auto refuse = [&](const std::string& place, const std::string& problem, const char* remedy) {
    throw InputError(file, place, problem, remedy);
  };
  for (const Json& required : entries(root, "extensionsRequired")) {
    const std::string name = required.is_string() ? required.get<std::string>() : required.dump();
    if (std::ranges::none_of(HARMLESS, [&](std::string_view start) { return name.starts_with(start); }))
      refuse("/extensionsRequired", fmt::format("the extension '{}' is not read", name),
             "export without it, such as without compression or instancing");
  }
  constexpr const char* STILL = "export the mesh as it stands, without skin, morph targets and animation";
  const std::vector<Json> accessors = entries(root, "accessors"), views = entries(root, "bufferViews");
  for (std::size_t i = 0; i < accessors.size(); ++i) {
    const Json view = named(accessors[i], "bufferView", views);
    if (accessors[i].is_object() && accessors[i].contains("sparse") && view.is_object() &&
        view.contains("byteStride"))
      refuse(fmt::format("/accessors/{}", i), "is sparse over interleaved numbers, which is not read",
             "export without sparse accessors");
  }
  for (const char* list : {"nodes", "meshes"}) {
    const std::vector<Json> all = entries(root, list);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string place = fmt::format("/{}/{}", list, i);
      if (all[i].is_object() && all[i].contains("skin"))
        refuse(place, "is bent by a skin, which is not read", STILL);
      if (has_weights(all[i])) refuse(place, "has weights of morph targets, which are not read", STILL);
    }
  }
  std::int64_t triangles = 0;
  for (const Json& mesh : entries(root, "meshes"))
    for (const Json& primitive : entries(mesh, "primitives")) triangles += triangles_of(primitive, accessors);
  return triangles;
}

}  // namespace lmdbench
