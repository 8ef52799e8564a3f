// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The command line for man pages and completion: read from the program's own CLI11 objects, so
/// that both agree with `--help`.
namespace lmdbench::manual {

struct OptionText {
  std::vector<std::string> names;   ///< "-o", "--out"; positional: one without dashes.
  std::string value;                ///< Its value: "TEXT", "NAME=NUMBER"; empty for a flag.
  std::string description;          ///< May have several lines.
  std::string usual;                ///< Default value; empty if none.
  std::vector<std::string> values;  ///< Possible values, where they are a known list.
  bool required = false;
  bool positional = false;
  bool repeatable = false;
};

struct CommandText {
  std::string path;  ///< After "lmdbench ": "run", "mesh info"; empty for the program.
  std::string description;
  std::string footer;
  std::vector<OptionText> options;
  std::vector<std::string> subcommands;  ///< Last words of their paths.
};

/// The program, then all commands, each followed by its subcommands.
/// @param known values of options by their long name
std::vector<CommandText> command_texts(const CLI::App& app,
                                       const std::map<std::string, std::vector<std::string>>& known);

}  // namespace lmdbench::manual
