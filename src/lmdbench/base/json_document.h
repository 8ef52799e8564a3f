// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/error.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

/// The one way to read JSON files. Every kind has a schema (draft 7) that names each key, its
/// meaning and default; every message names file, JSON pointer, line and remedy.
namespace lmdbench {

class JsonDocument {
 public:
  /// Parses, applies overrides ("/json/pointer=value"; each removes values of the file that exclude
  /// it), refuses unknown keys (suggesting the nearest), validates, then adds defaults.
  /// @param schema need not outlive the call
  /// @param code   of the errors: USAGE for a user's commands to the program, INPUT_DATA for data
  /// @param early  checks or adds before the schema is asked, where it knows more; throws
  /// @throws UsageError or InputError
  JsonDocument(std::string text, std::string file, const nlohmann::json& schema, ExitCode code,
               std::vector<std::string> overrides = {},
               const std::function<void(nlohmann::json&)>& early = {});

  const nlohmann::json& json() const { return json_; }
  nlohmann::json& json() { return json_; }
  const std::string& text() const { return text_; }
  /// In words: values of the file that overrides removed.
  const std::vector<std::string>& notes() const { return notes_; }

  /// For what a schema cannot say.
  /// @param pointer of the value at fault
  [[noreturn]] void fail(const std::string& pointer, const std::string& problem,
                         const std::string& remedy) const;

  /// Runs a check; to an `Error` whose place is a JSON pointer into this file it adds the line.
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
