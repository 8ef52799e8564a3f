// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <string>

/// Reads JSON text for people: places in messages, no lost keys, overrides from the command line.
namespace lmdbench {

/// Bounded in memory and depth: the result is at most JSON_DEPTH deep, with texts of at most
/// JSON_TEXT bytes, so that checks may recurse.
/// @throws UsageError: with line and column for text that is not JSON, with the key where an object
///   repeats one, with the limit where one is exceeded
nlohmann::json parse_json(const std::string& text, const std::string& file);

/// A document in one line, for standard output; bytes that are not UTF-8 (file names may hold any)
/// become U+FFFD.
std::string json_line(const nlohmann::ordered_json& document);

/// Applies one "/json/pointer=value"; a value that is not JSON is a string. "/methods/-" appends.
/// Makes missing parents: a list where the next step is "0" or "-", else an object.
/// @throws UsageError when the pointer is malformed, leads through a value that is neither object
///   nor array or past an array's end, when the text is not UTF-8, or above a limit of `parse_json`
void apply_override(nlohmann::json& document, const std::string& override_text);

/// The line, counted from 1, in which the value at a JSON pointer begins; for a value that is not
/// there (a missing key), that of the nearest enclosing one.
/// @param text that `parse_json` accepts
int line_of(const std::string& text, const std::string& pointer);

}  // namespace lmdbench
