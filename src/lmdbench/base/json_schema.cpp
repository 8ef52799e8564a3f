// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/json_schema.h>

#include <fmt/format.h>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include <algorithm>
#include <numeric>
#include <vector>

namespace lmdbench {
namespace {

using Json = nlohmann::json;
using Pointer = Json::json_pointer;

/// The schema with a local "$ref" followed.
const Json& follow(const Json& schema, const Json& root) {
  const auto reference = schema.find("$ref");
  return reference == schema.end() ? schema : root.at(Pointer(reference->get<std::string>().substr(1)));
}

/// "x-applies-when": whether a property exists in an object with these siblings.
bool applies(const Json& property, const Json& object) {
  const auto condition = property.find("x-applies-when");
  if (condition == property.end()) return true;
  for (const auto& [key, values] : condition->items()) {
    const auto sibling = object.find(key);
    if (sibling == object.end() || std::find(values.begin(), values.end(), *sibling) == values.end())
      return false;
  }
  return true;
}

void refuse_unknown(const Json& value, const Json& schema_or_reference, const Json& root,
                    const Pointer& place, const std::string& file) {
  const Json& schema = follow(schema_or_reference, root);
  if (value.is_array() && schema.contains("items")) {
    for (std::size_t i = 0; i < value.size(); ++i)
      refuse_unknown(value[i], schema["items"], root, place / i, file);
  }
  if (!value.is_object() || !schema.contains("properties")) return;
  const Json& properties = schema["properties"];
  std::vector<std::string> known;
  for (const auto& [key, property] : properties.items())
    if (applies(follow(property, root), value)) known.push_back(key);
  for (const auto& [key, child] : value.items()) {
    const bool is_known = std::find(known.begin(), known.end(), key) != known.end();
    if (is_known) {
      refuse_unknown(child, properties[key], root, place / key, file);
    } else if (schema.value("additionalProperties", true) == false) {
      const std::string near = nearest_word(key, known);
      std::string problem = fmt::format("unknown key \"{}\"", key);
      if (properties.contains(key)) {
        for (const auto& [sibling, values] : follow(properties[key], root)["x-applies-when"].items())
          problem =
              fmt::format("key \"{}\" exists only where \"{}\" is one of {}", key, sibling, values.dump());
      }
      throw UsageError(file, (place / key).to_string(), problem,
                       near.empty() ? fmt::format("known keys here: {}", fmt::join(known, ", "))
                                    : fmt::format("did you mean \"{}\"?", near));
    }
  }
}

void fill(Json& value, const Json& schema_or_reference, const Json& root) {
  const Json& schema = follow(schema_or_reference, root);
  if (value.is_array() && schema.contains("items")) {
    for (Json& item : value) fill(item, schema["items"], root);
  }
  if (!value.is_object() || !schema.contains("properties")) return;
  for (const auto& [key, property_or_reference] : schema["properties"].items()) {
    const Json& property = follow(property_or_reference, root);
    if (!value.contains(key) && property.contains("default") && applies(property, value))
      value[key] = property["default"];
    if (value.contains(key)) fill(value[key], property, root);
  }
}

/// The part of the schema that describes the value at `place`; an empty object when there is none.
Json schema_at(const std::vector<std::string>& place, const Json& root) {
  const Json* schema = &root;
  for (const std::string& step : place) {
    const Json& here = follow(*schema, root);
    if (here.contains("items")) {
      schema = &here["items"];
    } else if (here.contains("properties") && here["properties"].contains(step)) {
      schema = &here["properties"][step];
    } else {
      return Json::object();
    }
  }
  return follow(*schema, root);
}

/// What a value must be, in words, from its part of the schema.
std::string expectation(const Json& schema) {
  std::string text;
  if (schema.contains("type")) text = schema["type"].get<std::string>();
  if (schema.contains("enum")) text = fmt::format("one of {}", schema["enum"].dump());
  const auto add = [&](const char* keyword, const char* sign) {
    if (schema.contains(keyword)) text += fmt::format(" {} {}", sign, schema[keyword].dump());
  };
  add("exclusiveMinimum", ">");
  add("minimum", ">=");
  add("exclusiveMaximum", "<");
  add("maximum", "<=");
  add("pattern", "matching");
  const std::string description = schema.value("description", "");
  if (text.empty() || description.empty()) return text + description;
  return fmt::format("expected {}: {}", text, description);
}

}  // namespace

void refuse_unknown_keys(const Json& document, const Json& schema, const std::string& file) {
  refuse_unknown(document, schema, schema, Pointer(), file);
}

void validate_against_schema(const Json& document, const Json& schema_json, const std::string& file) {
  valijson::Schema schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  valijson::ValidationResults results;
  const valijson::adapters::NlohmannJsonAdapter target(document);
  if (valijson::Validator().validate(schema, target, &results)) return;

  // The validator reports the innermost violation first, then every enclosing
  // object: only the first one helps.
  valijson::ValidationResults::Error error;
  results.popError(error);
  std::vector<std::string> place;
  Pointer pointer;
  for (std::size_t i = 1; i < error.context.size(); ++i) {  // context[0] is "<root>", the rest "[key]"
    place.push_back(error.context[i].substr(1, error.context[i].size() - 2));
    pointer /= place.back();
  }
  std::string problem = error.description;
  if (!problem.empty() && problem.back() == '.') problem.pop_back();
  if (!place.empty()) problem += fmt::format(", found {}", document.at(pointer).dump());
  throw UsageError(file, place.empty() ? "/" : pointer.to_string(), problem,
                   expectation(schema_at(place, schema_json)));
}

void fill_defaults(Json& document, const Json& schema) {
  fill(document, schema, schema);
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  std::string nearest;
  // A slip is a third of the word at most; farther words would be guesses.
  std::size_t least = std::max<std::size_t>(word.size() / 3, 1) + 1;
  for (const std::string& candidate : candidates) {
    std::vector<std::size_t> row(candidate.size() + 1);  // Levenshtein distance, one row at a time
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::size_t diagonal = row[0]++;
      for (std::size_t j = 0; j < candidate.size(); ++j) {
        const std::size_t substituted = diagonal + (word[i] == candidate[j] ? 0 : 1);
        diagonal = row[j + 1];
        row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
      }
    }
    if (row.back() < least) {
      least = row.back();
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace lmdbench
