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
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <set>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

/// Of looks alone, or read by assimp (Draco). Endings of names are of versions.
constexpr std::array<std::string_view, 8> HARMLESS{
    "KHR_materials_", "KHR_texture_", "KHR_lights_",    "EXT_texture_",
    "MSFT_texture_",  "KHR_xmp",      "KHR_animation_", "KHR_draco_mesh_compression"};
constexpr std::string_view BASE64 = ";base64,";
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
    return depth != 1 || event != Json::parse_event_t::key || parsed != "images";
  };
  return Json::parse(json_of(bytes), is_kept, false);
}

/// A list of an object; an empty one where it is damaged, which assimp tells.
const Json& entries(const Json& object, const char* list) {
  static const Json none = Json::array();
  return object.is_object() && object.contains(list) && object[list].is_array() ? object[list] : none;
}

/// What an index in an object names in a list; null where there is none.
const Json& named(const Json& object, const char* key, const Json& list) {
  static const Json none;
  if (!object.is_object() || !object.contains(key) || !object[key].is_number_unsigned()) return none;
  const auto index = object[key].get<std::size_t>();
  return index < list.size() ? list[index] : none;
}

/// What a member of this name must be. In place of another value assimp takes its default.
struct Member {
  std::string_view name;
  const char* what;
  bool (*is_right)(const Json& value);
};

bool is_whole(const Json& value) {
  return value.is_number_unsigned();
}
/// Those of sparse accessors are an object.
bool is_index(const Json& value) {
  return is_whole(value) || value.is_object();
}
/// Those of the root are objects.
bool are_nodes(const Json& value) {
  return value.is_array() && (std::ranges::all_of(value, is_whole) ||
                              std::ranges::all_of(value, [](const Json& node) { return node.is_object(); }));
}
template <std::size_t COUNT>
bool are_numbers(const Json& value) {
  return value.is_array() && value.size() == COUNT &&
         std::ranges::all_of(value, [](const Json& number) { return number.is_number(); });
}
bool is_mode(const Json& value) {
  return is_whole(value) && value <= 6;
}
bool is_list(const Json& value) {
  return value.is_array();
}
bool are_indices(const Json& value) {
  return value.is_object() && std::ranges::all_of(value, is_whole);
}
constexpr const char* WHOLE = "a whole number from 0 on, written without a point";
constexpr const char* NODES = "a list of whole numbers from 0 on";

constexpr std::array<Member, 20> MEMBERS{
    {{"scene", WHOLE, is_whole},
     {"mesh", WHOLE, is_whole},
     {"buffer", WHOLE, is_whole},
     {"bufferView", WHOLE, is_whole},
     {"byteOffset", WHOLE, is_whole},
     {"byteLength", WHOLE, is_whole},
     {"byteStride", WHOLE, is_whole},
     {"componentType", WHOLE, is_whole},
     {"count", WHOLE, is_whole},
     {"indices", WHOLE, is_index},
     {"mode", "a whole number from 0 to 6", is_mode},
     {"nodes", NODES, are_nodes},
     {"children", NODES, are_nodes},
     {"matrix", "a list of 16 numbers", are_numbers<16>},
     {"translation", "a list of 3 numbers", are_numbers<3>},
     {"rotation", "a list of 4 numbers", are_numbers<4>},
     {"scale", "a list of 3 numbers", are_numbers<3>},
     {"primitives", "a list", is_list},
     {"extensionsRequired", "a list", is_list},
     {"attributes", "an object of whole numbers from 0 on", are_indices}}};

/// The triangles of a primitive; those of lines and points are none.
std::int64_t triangles_of(const Json& primitive, const Json& accessors) {
  constexpr std::int64_t TRIANGLES = 4, STRIP = 5, FAN = 6;
  if (!primitive.is_object()) return 0;
  const Json attributes = primitive.value("attributes", Json::object());
  const Json of = primitive.contains("indices") ? named(primitive, "indices", accessors)
                                                : named(attributes, "POSITION", accessors);
  const Json count = of.is_object() ? of.value("count", Json()) : Json();
  const std::int64_t mode = primitive.value("mode", TRIANGLES);
  if (!count.is_number_unsigned() || count > limit_of(Limit::TRIANGLES)) return 0;
  const auto corners = count.get<std::int64_t>();
  if (mode == TRIANGLES) return corners / 3;
  return mode == STRIP || mode == FAN ? std::max(corners - 2, std::int64_t{0}) : 0;
}

/// A file; what is damaged in other ways is left to assimp.
class Gltf {
 public:
  Gltf(std::string_view bytes, std::string file) : root_(root_of(bytes)), file_(std::move(file)) {}

  void check() const {
    if (!root_.is_object()) return;
    for (const char* list :
         {"extensionsRequired", "scene", "scenes", "nodes", "meshes", "accessors", "bufferViews"})
      if (root_.contains(list)) check_members(root_[list], fmt::format("/{}", list), list);
    for (const Json& required : entries(root_, "extensionsRequired")) {
      const std::string name = required.is_string() ? required.get<std::string>() : required.dump();
      if (std::ranges::none_of(HARMLESS, [&](std::string_view start) { return name.starts_with(start); }))
        refuse("/extensionsRequired", fmt::format("the extension '{}' is not read", name),
               "export without it, such as without compression or instancing");
    }
    for (const char* list : {"nodes", "meshes"})
      for_each(list, [&](const Json& object, const std::string& place) { refuse_motion(object, place); });
    for (const Json& mesh : entries(root_, "meshes"))
      for (const Json& primitive : entries(mesh, "primitives")) check_numbers(primitive);
    for_each("buffers", [&](const Json& buffer, const std::string& place) { check_base64(buffer, place); });
  }

  /// Of the meshes of the scene that assimp takes, each once.
  std::int64_t triangles() const {
    const Json &scenes = entries(root_, "scenes"), &nodes = entries(root_, "nodes"),
               &meshes = entries(root_, "meshes");
    static const Json first{{"scene", 0U}};
    const bool names_one = root_.is_object() && root_.contains("scene");
    std::vector<const Json*> to_see{&named(names_one ? root_ : first, "scene", scenes)};
    std::set<std::size_t> seen, shown;
    while (!to_see.empty()) {
      const Json& object = *to_see.back();  // the scene or one of its nodes
      to_see.pop_back();
      if (named(object, "mesh", meshes).is_object()) shown.insert(object["mesh"].get<std::size_t>());
      for (const char* list : {"nodes", "children"})
        for (const Json& index : entries(object, list))
          if (is_whole(index) && index < nodes.size() && seen.insert(index.get<std::size_t>()).second)
            to_see.push_back(&nodes[index.get<std::size_t>()]);
    }
    std::int64_t count = 0;
    for (const std::size_t mesh : shown)
      for (const Json& primitive : entries(meshes[mesh], "primitives"))
        count += triangles_of(primitive, entries(root_, "accessors"));
    return count;
  }

 private:
  [[noreturn]] void refuse(const std::string& place, const std::string& problem,
                           const char* remedy = "correct it, or export the mesh again") const {
    throw InputError(file_, place, problem, remedy);
  }

  void for_each(const char* list, const auto& take) const {
    const Json& all = entries(root_, list);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].is_object()) take(all[i], fmt::format("/{}/{}", list, i));
  }

  /// @param name  of the value in its object; none of an item of a list
  void check_members(const Json& value, const std::string& place, std::string_view name) const {
    const auto* const known = std::ranges::find(MEMBERS, name, &Member::name);
    if (known != MEMBERS.end() && !known->is_right(value))
      refuse(place, fmt::format("is not {}", known->what));
    if (value.is_object())
      for (const auto& [key, member] : value.items())
        if (key != "extensions" && key != "extras")
          check_members(member, fmt::format("{}/{}", place, key), key);
    if (value.is_array())
      for (std::size_t i = 0; i < value.size(); ++i)
        if (value[i].is_object()) check_members(value[i], fmt::format("{}/{}", place, i), "");
  }

  void refuse_motion(const Json& object, const std::string& place) const {
    constexpr const char* STILL = "export the mesh as it stands, without skin, morph targets and animation";
    if (object.contains("skin")) refuse(place, "is bent by a skin, which is not read", STILL);
    if (std::ranges::any_of(entries(object, "weights"), [](const Json& weight) { return weight != 0.0; }))
      refuse(place, "has weights of morph targets, which are not read", STILL);
  }

  /// Corners and indices are of kinds that glTF has; assimp takes other ones for these.
  void check_numbers(const Json& primitive) const {
    if (!primitive.is_object()) return;
    check_accessor(primitive.value("attributes", Json()), "POSITION", "VEC3", {5126}, 3);
    check_accessor(primitive, "indices", "SCALAR", {5121, 5123, 5125}, 1);
  }

  void check_accessor(const Json& object, const char* key, const char* type,
                      std::initializer_list<int> components, std::uint64_t count) const {
    const Json& accessor = named(object, key, entries(root_, "accessors"));
    if (!accessor.is_object()) return;
    const std::string place = fmt::format("/accessors/{}", object[key].get<std::size_t>());
    const Json component = accessor.value("componentType", Json());
    if (accessor.value("type", Json()) != type ||
        std::ranges::none_of(components, [&](int one) { return component == one; }))
      refuse(place,
             fmt::format("is not of type {} and component type {}", type, fmt::join(components, " or ")));
    const std::uint64_t bytes = count * bytes_of(component);
    const Json& view = named(accessor, "bufferView", entries(root_, "bufferViews"));
    const bool is_interleaved = view.is_object() && view.contains("byteStride");
    if (is_interleaved && view["byteStride"] < bytes)
      refuse(place, fmt::format("has {} bytes each, but one every {}", bytes, view["byteStride"].dump()));
    if (!accessor.contains("sparse")) return;
    const Json& sparse = accessor["sparse"];
    if (is_interleaved)
      refuse(place, "is sparse over interleaved numbers, which is not read",
             "export without sparse accessors");
    const Json indices = sparse.is_object() ? sparse.value("indices", Json()) : Json();
    if (!sparse.is_object() ||
        !holds(indices, sparse, indices.is_object() ? bytes_of(indices.value("componentType", Json())) : 0) ||
        !holds(sparse.value("values", Json()), sparse, bytes))
      refuse(place + "/sparse", "has fewer numbers than it says");
  }

  /// Of a component of a type that indices or corners may have; 0 of another one.
  static std::uint64_t bytes_of(const Json& component) {
    switch (is_whole(component) ? component.get<std::uint64_t>() : 0) {
      case 5121:
        return 1;
      case 5123:
        return 2;
      case 5125:
      case 5126:
        return 4;
      default:
        return 0;
    }
  }

  /// Whether a sparse accessor's indices or values are as many as it says.
  bool holds(const Json& part, const Json& sparse, std::uint64_t bytes) const {
    const Json& view = named(part, "bufferView", entries(root_, "bufferViews"));
    const std::uint64_t count = sparse.value("count", std::uint64_t{0});
    return bytes > 0 && view.is_object() && count <= static_cast<std::uint64_t>(limit_of(Limit::TRIANGLES)) &&
           part.value("byteOffset", std::uint64_t{0}) <= UINT32_MAX &&
           part.value("byteOffset", std::uint64_t{0}) + count * bytes <=
               view.value("byteLength", std::uint64_t{0});
  }

  void check_base64(const Json& buffer, const std::string& place) const {
    if (!buffer.contains("uri") || !buffer["uri"].is_string()) return;
    std::string_view text = buffer["uri"].get_ref<const std::string&>();
    const std::size_t mark = text.find(BASE64);
    if (!text.starts_with("data:") || mark == std::string_view::npos) return;
    text.remove_prefix(mark + BASE64.size());
    for (int padding = 0; padding < 2 && text.ends_with('='); ++padding) text.remove_suffix(1);
    const auto* const wrong = std::ranges::find_if(
        text, [](unsigned char c) { return std::isalnum(c) == 0 && c != '+' && c != '/'; });
    if (wrong != text.end())
      refuse(place + "/uri", fmt::format("has the byte {:#04x}, which is none of base64",
                                         static_cast<unsigned char>(*wrong)));
  }

  Json root_;
  std::string file_;
};

}  // namespace

std::int64_t check_gltf(std::string_view bytes, const std::string& file) {
  const Gltf gltf(bytes, file);
  gltf.check();
  return gltf.triangles();
}

}  // namespace lmdbench
