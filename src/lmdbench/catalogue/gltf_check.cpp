// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/catalogue/gltf_check.h>

#include <boost/endian/conversion.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace lmdbench {
namespace {

/// Of looks alone, or read by assimp (Draco). Endings of names are of versions.
constexpr std::array<std::string_view, 8> HARMLESS{
    "KHR_materials_", "KHR_texture_", "KHR_lights_",    "EXT_texture_",
    "MSFT_texture_",  "KHR_xmp",      "KHR_animation_", "KHR_draco_mesh_compression"};
constexpr const char* LIST = "extensionsRequired";
constexpr std::size_t GLB_HEADER = 12, CHUNK_HEADER = 8;

/// The JSON of either form.
std::string_view json_of(std::string_view bytes) {
  if (!bytes.starts_with("glTF") || bytes.size() < GLB_HEADER + CHUNK_HEADER) return bytes;
  const std::size_t length =
      boost::endian::load_little_u32(reinterpret_cast<const unsigned char*>(bytes.data()) + GLB_HEADER);
  return bytes.substr(GLB_HEADER + CHUNK_HEADER, length);
}

}  // namespace

void check_gltf(std::string_view bytes, const std::string& file) {
  using Event = nlohmann::json::parse_event_t;
  const nlohmann::json root = nlohmann::json::parse(
      json_of(bytes),
      [](int depth, Event event, const nlohmann::json& parsed) {
        return depth != 1 || event != Event::key || parsed == LIST;
      },
      false);
  if (!root.is_object() || !root.contains(LIST) || !root[LIST].is_array()) return;
  for (const nlohmann::json& required : root[LIST]) {
    const std::string name = required.is_string() ? required.get<std::string>() : required.dump();
    if (std::ranges::none_of(HARMLESS, [&](std::string_view start) { return name.starts_with(start); }))
      throw InputError(file, "/extensionsRequired", fmt::format("the extension '{}' is not read", name),
                       "export without it, such as without compression or instancing");
  }
}

}  // namespace lmdbench
