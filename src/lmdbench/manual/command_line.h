// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The command line as man pages and completion show it: read from the program's own CLI11 objects, so that neither can
/// tell another story than `--help`.
namespace lmdbench::manual {

struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--out"; a single name without dashes for a positional argument.
  std::string value;               ///< What follows it: "TEXT", "NAME=NUMBER"; empty for a flag.
  std::string description;         ///< May have several lines.
  std::string usual;               ///< Its value without the option; empty where there is none.
  std::vector<std::string> values;  ///< What may follow, where that is a known list; else empty.
  bool required = false;
  bool positional = false;
  bool repeatable = false;
};

struct CommandText {
  std::string path;  ///< Behind "lmdbench ": "run", "mesh info"; empty for the program itself.
  std::string description;
  std::string footer;
  std::vector<OptionText> options;
  std::vector<std::string> subcommands;  ///< Last words of their paths.
};

/// The program, then every command, subcommands behind theirs.
/// @param known values of options by their long name
std::vector<CommandText> command_texts(const CLI::App& app,
                                       const std::map<std::string, std::vector<std::string>>& known);

}  // namespace lmdbench::manual
