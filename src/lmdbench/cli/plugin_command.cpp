// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/plugin/check_plugin.h>
#include <lmdbench/plugin/new_project.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {
namespace {

std::string_view word(PluginFinding::Verdict verdict) {
  switch (verdict) {
    case PluginFinding::Verdict::PASSED:
      return "passed";
    case PluginFinding::Verdict::NOTED:
      return "noted";
    case PluginFinding::Verdict::FAILED:
      break;
  }
  return "failed";
}

void check(const std::string& file, bool json, int& exit_status) {
  const std::vector<PluginFinding> findings = check_plugin(file);
  for (const PluginFinding& finding : findings) {
    if (json)
      fmt::print("{}\n", nlohmann::ordered_json{{"method", finding.method},
                                                {"question", finding.question},
                                                {"verdict", word(finding.verdict)},
                                                {"answer", finding.answer}}
                             .dump());
    else
      fmt::print("{:<7} {}: {}{}{}\n", word(finding.verdict), finding.method, finding.question,
                 finding.answer.empty() ? "" : ": ", finding.answer);
  }
  const bool failed = std::ranges::any_of(findings, [](const PluginFinding& finding) {
    return finding.verdict == PluginFinding::Verdict::FAILED;
  });
  if (failed) exit_status = static_cast<int>(ExitCode::CHECK_FAILED);
}

}  // namespace

void add_plugin_command(CLI::App& app, int& exit_status) {
  CLI::App* plugin =
      app.add_subcommand("plugin", "methods from outside: begin one, check one (run takes it with --plugin)");
  plugin->require_subcommand(1);
  struct Arguments {
    std::string place, language = "c";
    bool json = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* make = plugin->add_subcommand("new", "write a project of a method that builds by itself");
  make->add_option("FOLDER", arguments->place, "where; the method is called as the folder is")->required();
  make->add_option("--language", arguments->language, "c, c++ or python")->capture_default_str();
  make->callback([arguments] {
    const std::string name = new_plugin(arguments->place, arguments->language);
    spdlog::info(
        "wrote {0}; go on with: cmake -S {0} -B {0}/build && cmake --build {0}/build && lmdbench plugin "
        "check {0}/build/{1}.so",
        arguments->place, name);
  });
  CLI::App* check_command = plugin->add_subcommand(
      "check", "put a plugin to scenes and poses whose answers are known; exit code 1 where it fails");
  check_command->add_option("FILE", arguments->place, "the shared object")->required();
  check_command->add_flag("--json", arguments->json, "one JSON object a question, a line each");
  check_command->callback(
      [arguments, &exit_status] { check(arguments->place, arguments->json, exit_status); });
}

}  // namespace lmdbench
