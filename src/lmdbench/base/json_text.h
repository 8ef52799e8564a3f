// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

/// Reading JSON text for people: places in messages, no silently lost keys, overrides from the command line.
namespace lmdbench {

/// Bounded in memory and depth: what comes back is at most JSON_DEPTH deep, with texts of at most JSON_TEXT
/// bytes, so that checks may go down by recursion.
/// @throws UsageError with line and column for text that is not JSON, with the key for one that an object
/// repeats, with the limit for what is above one
nlohmann::json parse_json(const std::string& text, const std::string& file);

/// A document in one line, for standard output; bytes that are no UTF-8 (names of files may hold any) become
/// U+FFFD.
std::string json_line(const nlohmann::ordered_json& document);

/// Applies one "/json/pointer=value"; a value that is not JSON is taken as a string. "/methods/-" appends. What is
/// not there yet is made: a list where the next step is "0" or "-", else an object.
/// @throws UsageError when the pointer is malformed, leads through a value that is neither object nor array or
/// past an array's end, when the text is no UTF-8, or above a limit of `parse_json`
void apply_override(nlohmann::json& document, const std::string& override_text);

/// The line, counted from 1, in which the value at a JSON pointer begins; that of the nearest enclosing value
/// that is there where it is not (a missing key).
/// @param text that `parse_json` accepts
int line_of(const std::string& text, const std::string& pointer);

}  // namespace lmdbench
