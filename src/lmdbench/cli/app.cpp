// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/base/json_schema.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/cli/app.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/examples.h>
#include <lmdbench/plugin/plugin.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lmdbench {
namespace {

struct CommonOptions {
  int verbose = 0;
  int quiet = 0;
  std::vector<std::string> limits;
  std::vector<std::string> plugins, trusted_plugins;
};

std::string limits_help() {
  std::string text = "raise or lower a limit on input; repeatable. Limits and their usual values:";
  for (const LimitInfo& info : limit_table())
    text += fmt::format("\n{} ({}): {}", info.name, info.usual, info.meaning);
  return text;
}

bool is_option(const std::string& word) {
  return word.size() > 1 && word.front() == '-';
}

/// "did you mean ...?", or else `otherwise`.
std::string suggestion(const std::string& word, const std::vector<std::string>& known,
                       const std::string& otherwise) {
  const std::string near = nearest_word(word, known);
  return near.empty() ? otherwise : fmt::format("did you mean \"{}\"?", near);
}

}  // namespace

std::shared_ptr<CLI::App> make_app(const std::vector<std::string>& argv, int& exit_status) {
  auto app = std::make_shared<CLI::App>(
      "Bench for multi-contact haptic rendering with local minimum distances", "lmdbench");
  app->require_subcommand(1);
  app->fallthrough();  // -v and -q also work after the subcommand
  app->set_version_flag("--version", version_text());
  const auto common = std::make_shared<CommonOptions>();
  app->add_flag("-v,--verbose", common->verbose, "tell more; run prints all numbers, not a table alone");
  app->add_flag("-q,--quiet", common->quiet,
                "tell errors only; answers (query, compare, --json) are printed all the same");
  app->add_option("--limit", common->limits, limits_help())
      ->type_name("NAME=NUMBER")
      ->allow_extra_args(false);
  app->add_option(
         "--plugin", common->plugins,
         "add the methods of a plugin (lmdbench_method.h), which runs in a process of its own; repeatable")
      ->type_name("FILE.so")
      ->allow_extra_args(false);
  app->add_option("--trusted-plugin", common->trusted_plugins,
                  "the same, but the plugin runs in this program")
      ->type_name("FILE.so")
      ->allow_extra_args(false);
  app->parse_complete_callback([common] {
    set_up_talk(common->verbose - common->quiet);
    for (const std::string& limit : common->limits) set_limit(limit);
    for (const std::string& file : common->plugins) add_plugin(file, PluginTrust::NONE);
    for (const std::string& file : common->trusted_plugins) add_plugin(file, PluginTrust::TRUSTED);
  });
  app->footer(
      "Exit codes: 0 done; 1 a check failed; 2 usage or experiment file wrong; 3 input data wrong; "
      "4 the environment lacks something; 70 a bug of lmdbench.");
  add_commands(*app, argv, exit_status);
  add_examples(*app);
  return app;
}

UsageError usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  std::string call = app.get_name();
  std::vector<std::string> options;
  const auto add_options = [&] {
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  };
  add_options();
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    call += " " + command->get_name();
    add_options();
  }
  const std::string help = "see " + call + " --help";
  const std::vector<std::string> extras = app.remaining(true);
  const bool lacks_command = command->get_require_subcommand_min() > 0;
  // After an unknown command nothing is known; after a known one, an unknown option has a value.
  const auto culprit = lacks_command ? extras.begin() : std::ranges::find_if(extras, is_option);
  if (culprit != extras.end() && is_option(*culprit)) {
    const std::string name = culprit->substr(0, culprit->find('='));
    return {"", "", fmt::format("{} has no option {}", call, name), suggestion(name, options, help)};
  }
  if (lacks_command) {
    std::vector<std::string> commands;
    for (const CLI::App* known : command->get_subcommands([](const CLI::App*) { return true; }))
      commands.push_back(known->get_name());
    const std::string known = fmt::format("the commands are {}; {}", fmt::join(commands, ", "), help);
    if (extras.empty()) return {"", "", fmt::format("{} needs a command", call), known};
    return {"", "", fmt::format("{} has no command \"{}\"", call, *culprit),
            suggestion(*culprit, commands, known)};
  }
  if (!extras.empty())
    return {"", "", fmt::format("{} takes no further argument \"{}\"", call, extras.front()), help};
  return {"", "", error.what(), help};
}

}  // namespace lmdbench
