// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/limits.h>
#include <lmdbench/manual/manual.h>
#include <lmdbench/methods/registry.h>
#ifdef LMDBENCH_HAS_EXPERIMENTS
#include <lmdbench/experiment/experiment.h>
#endif

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lmdbench::manual {
namespace {

#ifdef LMDBENCH_HAS_EXPERIMENTS
/// JSON pointers of an experiment's values, except those within lists.
void append_places(const nlohmann::json& schema, const nlohmann::json& part, const std::string& pointer,
                   std::vector<std::string>& places) {
  if (const auto reference = part.find("$ref"); reference != part.end()) {
    const std::string to = reference->get<std::string>();
    if (to.starts_with("#/"))
      append_places(schema, schema.at(nlohmann::json::json_pointer(to.substr(1))), pointer, places);
    return;
  }
  for (const char* list : {"anyOf", "oneOf", "allOf"})
    if (part.contains(list))
      for (const auto& choice : part[list]) append_places(schema, choice, pointer, places);
  if (!part.contains("properties")) return;
  for (const auto& [name, property] : part["properties"].items()) {
    const std::string place = fmt::format("{}/{}", pointer, name);
    if (name.starts_with("$")) continue;
    const std::size_t before = places.size();
    append_places(schema, property, place, places);
    if (places.size() == before) places.push_back(place + "=");
  }
}
#endif

}  // namespace

std::map<std::string, std::vector<std::string>> known_values() {
  std::map<std::string, std::vector<std::string>> values;
  values["--method"] = method_names();
  for (const LimitInfo& limit : limit_table()) values["--limit"].push_back(std::string(limit.name) + "=");
#ifdef LMDBENCH_HAS_EXPERIMENTS
  const nlohmann::json& schema = experiment_schema();
  append_places(schema, schema, "", values["--set"]);
  const nlohmann::json& kinds = schema.at("/properties/driver/properties/kind/enum"_json_pointer);
  values["--driver"] = kinds.get<std::vector<std::string>>();
#endif
  return values;
}

}  // namespace lmdbench::manual
