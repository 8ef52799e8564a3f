// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

/// Reading JSON text for people: places in messages, no silently lost keys, overrides from the command line.
namespace lmdbench {

/// @throws UsageError with line and column for text that is not JSON, with the key for one that an
///         object repeats
nlohmann::json parse_json(const std::string& text, const std::string& file);

/// Applies one "/json/pointer=value"; a value that is not JSON is taken as a string. "/methods/-" appends.
/// @throws UsageError when the pointer is malformed or leads through a value that is neither object nor array
void apply_override(nlohmann::json& document, const std::string& override_text);

}  // namespace lmdbench
