// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/// Checking and completing JSON documents against a draft-07 schema. Two things are done here
/// instead of by the validator, because its messages could not help the user: unknown keys (with
/// the nearest known one) and defaults.
namespace lmdbench {

/// Refuses keys unknown to the schema wherever it says "additionalProperties": false, and keys that
/// exclude each other by "dependencies": {KEY: {"properties": {OTHER: false}}}; {"const": DEFAULT}
/// in place of false for an OTHER that `fill_defaults` puts there. Properties that exist only
/// beside certain values are given by "allOf": [{"if": {"properties": {KEY: {"const": VALUE}}},
/// "then": SCHEMA}].
/// @throws UsageError with the JSON pointer of the first such key, or of the object that has two
void refuse_unknown_keys(const nlohmann::json& document, const nlohmann::json& schema,
                         const std::string& file);

/// The values of the document that must not stand beside the one at a place.
/// @param pointer of a value that is there
/// @return JSON pointers
std::vector<std::string> excluded_by(const nlohmann::json& document, const nlohmann::json& schema,
                                     const std::string& pointer);

/// @throws UsageError with the JSON pointer of the first violation
void validate_against_schema(const nlohmann::json& document, const nlohmann::json& schema,
                             const std::string& file);

/// Adds every absent property that has a "default" (and applies), to any depth.
void fill_defaults(nlohmann::json& document, const nlohmann::json& schema);

/// The candidate nearest to `word` by edit distance (swapped neighbours are one edit), or an empty
/// string when none is near enough to be a slip.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace lmdbench
