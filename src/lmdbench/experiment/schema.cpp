// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/deformation.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/experiment/probe.h>
#include <lmdbench/experiment/rules.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <string>

namespace lmdbench {

/// experiments/schema/experiment.schema.json as of the build.
const std::string& experiment_schema_text();

namespace {

using Json = nlohmann::json;

/// An entry of "methods" with the options of each method, which depend on its name.
void add_method_options(Json& entry) {
  Json choices = Json::array();
  for (const MethodDescription& method : method_descriptions()) {
    Json properties = entry["properties"];
    properties.update(method.options);
    choices.push_back(
        {{"if", {{"properties", {{"name", {{"const", method.name}}}}}, {"required", {"name"}}}},
         {"then",
          {{"description", method.summary}, {"additionalProperties", false}, {"properties", properties}}}});
  }
  entry["properties"]["name"]["enum"] = method_names();
  entry["allOf"] = std::move(choices);
}

/// The aggregations and their summaries.
void add_aggregations(Json& choice) {
  choice["enum"] = aggregation_names();
  std::string text = choice["description"].get<std::string>();
  for (const Aggregation& law : aggregations()) text += fmt::format("; {}: {}", law.name, law.summary);
  choice["description"] = text;
}

/// The generators that there are.
void add_generators(Json& choice) {
  choice["enum"] = Json::array();
  for (const DeformationKind kind : deformation_kinds()) choice["enum"].push_back(to_string(kind));
}

}  // namespace

const Json& experiment_schema() {
  // Plugins add methods at the program's start; earlier callers keep the schema they have.
  static std::map<std::size_t, Json> schemas;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const auto [known, is_new] = schemas.try_emplace(method_descriptions().size());
  Json& text = known->second;
  if (!is_new) return text;
  text = Json::parse(experiment_schema_text());
  add_method_options(text["properties"]["methods"]["items"]);
  add_aggregations(text["properties"]["force"]["properties"]["aggregation"]);
  add_generators(text["definitions"]["deformation"]["properties"]["generator"]);
  text["properties"]["plan"] = rules_schema();
  add_probe_schemas(text);
  return text;
}

}  // namespace lmdbench
