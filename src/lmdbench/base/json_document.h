// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/error.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

/// The one way that JSON files are read: every kind has a schema (draft 7) that names each key, its meaning and its
/// default, and every message names file, JSON pointer, line and remedy.
namespace lmdbench {

class JsonDocument {
 public:
  /// Parses, applies overrides ("/json/pointer=value"; each replaces what the file gives that excludes it), refuses keys that the schema does not know (suggesting the
  /// nearest), checks against the schema and adds what is absent and has a default.
  /// @param schema outlives nothing: it is read here only
  /// @param code   of the errors: USAGE for what a user writes to command the program, INPUT_DATA for data
  /// @param early  what is to be said or added before the schema is asked, because it knows more; throws
  /// @throws UsageError or InputError
  JsonDocument(std::string text, std::string file, const nlohmann::json& schema, ExitCode code,
               std::vector<std::string> overrides = {},
               const std::function<void(nlohmann::json&)>& early = {});

  const nlohmann::json& json() const { return json_; }
  nlohmann::json& json() { return json_; }
  const std::string& text() const { return text_; }
  /// What overrides replaced beside their own value, in words.
  const std::vector<std::string>& notes() const { return notes_; }

  /// For what a schema cannot say.
  /// @param pointer of the value at fault
  [[noreturn]] void fail(const std::string& pointer, const std::string& problem,
                         const std::string& remedy) const;

  /// Runs what may throw an `Error` whose place is a JSON pointer into this file, and adds the line to it.
  template <typename Check>
  auto locate(const Check& check) const {
    try {
      return check();
    } catch (const Error& error) {
      rethrow(error);
    }
  }

 private:
  void override_with(const std::string& entry, const nlohmann::json& schema);
  [[noreturn]] void rethrow(const Error& error) const;
  std::string place(const std::string& pointer) const;

  std::string text_;
  std::string file_;
  ExitCode code_;
  std::vector<std::string> overrides_;
  std::vector<std::string> notes_;
  nlohmann::json json_;
};

}  // namespace lmdbench
