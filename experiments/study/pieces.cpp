// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <study/pieces.h>

#include <algorithm>

namespace lmdbench::study {

Arguments arguments_without(const CLI::App& command, const std::vector<std::string>& options) {
  Arguments arguments{command.get_name()};
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || name == "--json" ||
        std::find(options.begin(), options.end(), name) != options.end())
      continue;
    const bool is_flag = option->get_items_expected_max() == 0;
    for (const std::string& value : option->results()) {
      if (is_flag)
        arguments.push_back(name);
      else
        arguments.push_back(option->get_positional() ? value : name + "=" + value);
    }
  }
  return arguments;
}

std::vector<Arguments> pieces_by(const CLI::App& command, const std::vector<Split>& splits) {
  std::vector<std::string> options;
  for (const Split& split : splits) options.push_back(split.option);
  std::vector<Arguments> pieces{arguments_without(command, options)};
  for (const Split& split : splits) {
    std::vector<Arguments> finer;
    for (const Arguments& piece : pieces) {
      for (const std::string& value : split.values) {
        finer.push_back(piece);
        finer.back().push_back(split.option + "=" + value);
      }
    }
    pieces = std::move(finer);
  }
  return pieces;
}

std::vector<std::string> texts(const std::vector<double>& values) {
  std::vector<std::string> result;
  for (const double value : values) result.push_back(fmt::format("{}", value));
  return result;
}

std::string pieces_json(const CLI::App& app, const Run& chosen) {
  if (chosen.pieces) return nlohmann::json(chosen.pieces()).dump();
  return nlohmann::json(std::vector<Arguments>{arguments_without(*app.get_subcommands().front(), {})}).dump();
}

}  // namespace lmdbench::study
