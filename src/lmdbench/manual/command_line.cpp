// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/manual/command_line.h>

#include <CLI/CLI.hpp>

namespace lmdbench::manual {
namespace {

using KnownValues = std::map<std::string, std::vector<std::string>>;

OptionText option_text(const CLI::Option& option, const KnownValues& known) {
  OptionText text;
  text.positional = option.get_positional();
  if (text.positional) {
    text.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) {
      text.names.push_back("--" + name);
      if (const auto values = known.find("--" + name); values != known.end()) text.values = values->second;
    }
  }
  if (option.get_type_size() != 0) text.value = option.get_type_name();
  text.description = option.get_description();
  text.usual = option.get_default_str();
  text.required = option.get_required();
  text.repeatable = option.get_items_expected_max() > 1;
  return text;
}

void append(const CLI::App& app, const std::string& path, const KnownValues& known,
            std::vector<CommandText>& texts) {
  CommandText text;
  text.path = path;
  text.description = app.get_description();
  text.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) text.options.push_back(option_text(*option, known));
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* command : commands) text.subcommands.push_back(command->get_name());
  texts.push_back(std::move(text));
  for (const CLI::App* command : commands)
    append(*command, path.empty() ? command->get_name() : path + " " + command->get_name(), known, texts);
}

}  // namespace

std::vector<CommandText> command_texts(const CLI::App& app, const KnownValues& known) {
  std::vector<CommandText> texts;
  append(app, "", known, texts);
  return texts;
}

}  // namespace lmdbench::manual
