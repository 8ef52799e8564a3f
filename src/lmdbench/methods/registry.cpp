// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/json_schema.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/lmd/near_frame.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/scene/scene_search.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

auto find(std::string_view name) {
  const auto& all = method_descriptions();
  return std::find_if(all.begin(), all.end(),
                      [&](const MethodDescription& description) { return description.name == name; });
}

/// The vertex with most triangles.
struct LargestFan {
  std::int32_t vertex = -1;
  std::int64_t triangles = 0;

  static LargestFan of(const Surface& surface) {
    LargestFan largest;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(surface.mesh.vertices.size()); ++v) {
      const auto triangles = static_cast<std::int64_t>(surface.adjacency.vertex_triangles[v].size());
      if (triangles > largest.triangles) largest = {v, triangles};
    }
    return largest;
  }
};

/// Where two hubs meet, every method looks at all pairs of their triangles.
void refuse_two_hubs(const Scene& scene) {
  const Body *of_mover = nullptr, *last = nullptr;
  for (std::size_t mover = 0; mover < scene.mover_count(); ++mover) {
    const Body& one = *scene.body(mover);
    if (&one == std::exchange(of_mover, &one)) continue;  // another instance, as below
    const auto& moving = one.prepared<LargestFan>();
    for (std::size_t other = mover + 1; other < scene.object_count(); ++other) {
      const Body& body = *scene.body(other);
      if (&body == std::exchange(last, &body)) continue;
      const auto& fixed = body.prepared<LargestFan>();
      if (moving.triangles * fixed.triangles <= limit_of(Limit::VERTEX_PAIRS)) continue;
      throw InputError(one.name(), fmt::format("vertex {}", moving.vertex),
                       fmt::format("is in {} triangles, and vertex {} of {} in {}: {} pairs where they meet, "
                                   "above the limit of {}",
                                   moving.triangles, fixed.vertex, body.name(), fixed.triangles,
                                   moving.triangles * fixed.triangles, limit_of(Limit::VERTEX_PAIRS)),
                       "make grids of the fans, or " + raise_remedy(Limit::VERTEX_PAIRS));
    }
    last = nullptr;
  }
}

}  // namespace

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const MethodDescription& description : method_descriptions()) names.push_back(description.name);
  return names;
}

const MethodDescription& method_description(std::string_view name, const std::string& file,
                                            const std::string& place) {
  const auto found = find(name);
  if (found != method_descriptions().end()) return *found;
  for (const MissingMethod& missing : missing_methods())
    if (missing.name == name)
      throw missing_part(missing.part, file, place, fmt::format("the method \"{}\"", name));
  const std::string near = nearest_word(std::string(name), method_names());
  throw UsageError(file, place, fmt::format("unknown method \"{}\"", name),
                   near.empty() ? fmt::format("known methods: {}; --plugin FILE.so adds others",
                                              fmt::join(method_names(), ", "))
                                : fmt::format("did you mean \"{}\"?", near));
}

std::size_t method_order(std::string_view name) {
  return static_cast<std::size_t>(find(name) - method_descriptions().begin());
}

Json complete_options(const MethodDescription& description, Json options, const std::string& file) {
  const Json schema{{"type", "object"}, {"additionalProperties", false}, {"properties", description.options}};
  if (options.is_null()) options = Json::object();
  refuse_unknown_keys(options, schema, file);
  validate_against_schema(options, schema, file);
  fill_defaults(options, schema);
  return options;
}

std::unique_ptr<Method> make_method(std::string_view name, const Scene& scene, const Json& options) {
  const MethodDescription& description = method_description(name);
  auto make = [&description,
               complete = complete_options(description, options, "options of " + description.name)](
                  const Scene& of_pair) { return description.make(of_pair, complete); };
  refuse_two_hubs(scene);
  // A method that sees two bodies itself and follows them needs no frames and no new instances.
  if (scene.is_pair() && description.follows_deformation && !NearFrame(scene).differs()) return make(scene);
  return std::make_unique<SceneSearch>(scene, description, std::move(make));
}

std::string methods_help() {
  std::string text = "Methods and their options:\n";
  for (const MethodDescription& description : method_descriptions()) {
    text +=
        fmt::format("  {}: {} ({})\n", description.name, description.summary, to_string(description.promise));
    for (const auto& [key, property] : description.options.items())
      text += fmt::format(
          "    {} = {} ({}): {}\n", key, property["default"].dump(),
          property.contains("enum") ? property["enum"].dump() : property["type"].get<std::string>(),
          property["description"].get<std::string>());
  }
  return text;
}

}  // namespace lmdbench
