// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/cli/app.h>
#include <lmdbench/cli/commands.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace lmdbench {
namespace {

struct CommonOptions {
  int verbose = 0;
  int quiet = 0;
  std::vector<std::string> limits;
};

std::string limits_help() {
  std::string text = "raise or lower a limit on input; repeatable. Limits and their usual values:";
  for (const LimitInfo& info : limit_table())
    text += fmt::format("\n{} ({}): {}", info.name, info.usual, info.meaning);
  return text;
}

}  // namespace

std::shared_ptr<CLI::App> make_app(const std::vector<std::string>& argv, int& exit_status) {
  auto app = std::make_shared<CLI::App>(
      "Bench for multi-contact haptic rendering with local minimum distances", "lmdbench");
  app->require_subcommand(1);
  app->fallthrough();  // -v and -q work behind the subcommand, too
  app->set_version_flag("--version", version_text());
  const auto common = std::make_shared<CommonOptions>();
  app->add_flag("-v,--verbose", common->verbose, "tell more on standard error");
  app->add_flag("-q,--quiet", common->quiet, "tell errors only");
  app->add_option("--limit", common->limits, limits_help())
      ->type_name("NAME=NUMBER")
      ->allow_extra_args(false);
  app->parse_complete_callback([common] {
    set_up_talk(common->verbose - common->quiet);
    for (const std::string& limit : common->limits) set_limit(limit);
  });
  app->footer(
      "Exit codes: 0 done; 1 a check failed; 2 usage or experiment file wrong; 3 input data wrong; "
      "4 the environment lacks something; 70 a bug of lmdbench.");
  add_commands(*app, argv, exit_status);
  return app;
}

}  // namespace lmdbench
