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
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>
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

/// The schema of every key of an object that is a map (no named keys); null where there is none.
const Json* schema_of_other_keys(const Json& schema) {
  const auto other = schema.find("additionalProperties");
  const bool is_map = other != schema.end() && other->is_object() && !schema.contains("properties");
  return is_map ? &*other : nullptr;
}

/// Whether the object has the constants of an "if".
bool holds(const Json& condition, const Json& object) {
  if (!object.is_object()) return false;
  for (const auto& [key, property] : condition["properties"].items())
    if (!object.contains(key) || object[key] != property["const"]) return false;
  return true;
}

/// The schemas that hold for a value: its own, and every "then" of its "allOf" whose "if" it meets.
std::vector<const Json*> schemas_for(const Json& value, const Json& schema_or_reference, const Json& root) {
  const Json& schema = follow(schema_or_reference, root);
  std::vector<const Json*> result{&schema};
  if (const auto choices = schema.find("allOf"); choices != schema.end())
    for (const Json& choice : *choices)
      if (holds(choice["if"], value)) result.push_back(&follow(choice["then"], root));
  return result;
}

/// The constants that would allow the object a key, in words; empty where none would.
std::string where_it_exists(const std::string& key, const Json& choices) {
  std::map<std::string, std::vector<std::string>> constants;  // by the property that has them
  for (const Json& choice : choices)
    if (choice["then"]["properties"].contains(key))
      for (const auto& [sibling, property] : choice["if"]["properties"].items())
        constants[sibling].push_back(property["const"].dump());
  std::string text;
  for (const auto& [sibling, values] : constants)
    text +=
        fmt::format("{}\"{}\" is one of [{}]", text.empty() ? "" : " and ", sibling, fmt::join(values, ","));
  return text;
}

/// The present keys that must not be beside another one.
std::vector<std::string> excluded_keys(const Json& object, const std::string& key, const Json& schema) {
  std::vector<std::string> excluded;
  if (!schema.contains("dependencies")) return excluded;
  for (const auto& [one, rule] : schema["dependencies"].items())
    for (const auto& [other, allowed] : rule["properties"].items()) {
      if (!object.contains(one) || !object.contains(other)) continue;
      // A resolved document has the default; only another value was asked for.
      if (allowed != false && (!allowed.contains("const") || allowed["const"] == object[other])) continue;
      if (one == key) excluded.push_back(other);
      if (other == key) excluded.push_back(one);
    }
  return excluded;
}

void refuse_unknown(const Json& value, const Json& schema_or_reference, const Json& root,
                    const Pointer& place, const std::string& file) {
  const Json& whole = follow(schema_or_reference, root);
  for (const Json* schema : schemas_for(value, whole, root)) {
    if (value.is_array() && schema->contains("items")) {
      for (std::size_t i = 0; i < value.size(); ++i)
        refuse_unknown(value[i], (*schema)["items"], root, place / i, file);
    }
    if (!value.is_object()) continue;
    if (const Json* other = schema_of_other_keys(*schema))
      for (const auto& [key, child] : value.items()) refuse_unknown(child, *other, root, place / key, file);
    if (!schema->contains("properties")) continue;
    const Json& properties = (*schema)["properties"];
    for (const auto& [key, child] : value.items()) {
      if (properties.contains(key)) {
        if (const auto excluded = excluded_keys(value, key, *schema); !excluded.empty())
          throw UsageError(file, place.to_string(),
                           fmt::format("\"{}\" and \"{}\" exclude each other", key, excluded.front()),
                           "give at most one of the two");
        refuse_unknown(child, properties[key], root, place / key, file);
      } else if (schema->contains("additionalProperties") && (*schema)["additionalProperties"] == false) {
        std::vector<std::string> known;
        for (const auto& property : properties.items()) known.push_back(property.key());
        const std::string near = nearest_word(key, known);
        const std::string elsewhere = where_it_exists(key, whole.value("allOf", Json::array()));
        throw UsageError(file, (place / key).to_string(),
                         elsewhere.empty() ? fmt::format("unknown key \"{}\"", key)
                                           : fmt::format("key \"{}\" exists only where {}", key, elsewhere),
                         near.empty() ? fmt::format("known keys here: {}", fmt::join(known, ", "))
                                      : fmt::format("did you mean \"{}\"?", near));
      }
    }
  }
}

void fill(Json& value, const Json& schema_or_reference, const Json& root) {
  for (const Json* schema : schemas_for(value, schema_or_reference, root)) {
    if (value.is_array() && schema->contains("items")) {
      for (Json& item : value) fill(item, (*schema)["items"], root);
    }
    if (!value.is_object()) continue;
    if (const Json* other = schema_of_other_keys(*schema))
      for (auto& child : value.items()) fill(child.value(), *other, root);
    if (!schema->contains("properties")) continue;
    for (const auto& [key, property_or_reference] : (*schema)["properties"].items()) {
      const Json& property = follow(property_or_reference, root);
      if (!value.contains(key) && property.contains("default")) value[key] = property["default"];
      if (value.contains(key)) fill(value[key], property, root);
    }
  }
}

/// The schema of the document's value at `place`; an empty object when there is none.
Json schema_at(const std::vector<std::string>& place, const Json& root, const Json& document) {
  const Json* schema = &root;
  const Json* value = &document;
  for (const std::string& step : place) {
    const Json* next = nullptr;
    for (const Json* here : schemas_for(*value, *schema, root)) {
      if (value->is_array() && here->contains("items"))
        next = &(*here)["items"];
      else if (here->contains("properties") && (*here)["properties"].contains(step))
        next = &(*here)["properties"][step];
      else if (const Json* other = schema_of_other_keys(*here))
        next = other;
    }
    if (next == nullptr) return Json::object();
    schema = next;
    value = value->is_array() ? &value->at(std::stoul(step)) : &value->at(step);
  }
  return follow(*schema, root);
}

/// The validator's form of a schema, kept: making it takes longer than checking most documents, and
/// a sweep checks one document a point.
const valijson::Schema& prepared(const Json& schema) {
  static std::mutex mutex;
  static std::map<Json, std::unique_ptr<const valijson::Schema>> known;
  const std::scoped_lock lock(mutex);
  auto place = known.find(schema);
  if (place == known.end()) {
    auto made = std::make_unique<valijson::Schema>();
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema), *made);
    place = known.emplace(schema, std::move(made)).first;
  }
  return *place->second;
}

/// Description of the values that a schema allows.
std::string expectation(const Json& schema) {
  std::string text;
  if (schema.contains("type"))
    text = schema["type"].is_array() ? fmt::format("one of the types {}", schema["type"].dump())
                                     : schema["type"].get<std::string>();
  if (schema.contains("enum")) text = fmt::format("one of {}", schema["enum"].dump());
  if (schema.contains("const")) text = schema["const"].dump();
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

std::vector<std::string> excluded_by(const Json& document, const Json& schema, const std::string& pointer) {
  Pointer parent(pointer);
  if (parent.empty()) return {};
  const std::string key = parent.back();
  parent.pop_back();
  if (!document.contains(parent) || !document[parent].is_object()) return {};
  std::vector<std::string> place;
  for (Pointer rest = parent; !rest.empty(); rest.pop_back()) place.insert(place.begin(), rest.back());
  std::vector<std::string> excluded =
      excluded_keys(document[parent], key, schema_at(place, schema, document));
  for (std::string& other : excluded) other = (parent / other).to_string();
  return excluded;
}

void validate_against_schema(const Json& document, const Json& schema_json, const std::string& file) {
  valijson::ValidationResults results;
  const valijson::adapters::NlohmannJsonAdapter target(document);
  thread_local valijson::Validator validator;  // keeps the patterns that it has compiled
  if (validator.validate(prepared(schema_json), target, &results)) return;

  // The validator reports the innermost violation first, then every enclosing object: only the
  // first helps.
  valijson::ValidationResults::Error error;
  results.popError(error);
  std::vector<std::string> place;
  Pointer pointer;
  for (std::size_t i = 1; i < error.context.size(); ++i) {  // [0]: "<root>", else "[key]"
    place.push_back(error.context[i].substr(1, error.context[i].size() - 2));
    pointer /= place.back();
  }
  std::string problem = error.description;
  if (!problem.empty() && problem.back() == '.') problem.pop_back();
  if (!place.empty()) problem += fmt::format(", found {}", document.at(pointer).dump());
  const bool lacks_key = problem.starts_with("Missing required property");
  throw UsageError(file, place.empty() ? "/" : pointer.to_string(), problem,
                   lacks_key ? "add it" : expectation(schema_at(place, schema_json, document)));
}

void fill_defaults(Json& document, const Json& schema) {
  fill(document, schema, schema);
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  std::string nearest;
  // A slip changes a third of the word at most; farther words would be guesses.
  std::size_t least = std::max<std::size_t>(word.size() / 3, 1) + 1;
  for (const std::string& candidate : candidates) {
    // Levenshtein distance, one row at a time; two swapped neighbours are one slip, too.
    std::vector<std::size_t> row(candidate.size() + 1), above, above_that;
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < word.size(); ++i) {
      above_that = std::exchange(above, row);
      row[0] = i + 1;
      for (std::size_t j = 0; j < candidate.size(); ++j) {
        row[j + 1] = std::min({above[j] + (word[i] == candidate[j] ? 0 : 1), row[j] + 1, above[j + 1] + 1});
        if (i > 0 && j > 0 && word[i] == candidate[j - 1] && word[i - 1] == candidate[j])
          row[j + 1] = std::min(row[j + 1], above_that[j - 1] + 1);
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
