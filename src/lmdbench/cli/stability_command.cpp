// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/progress_bar.h>
#include <lmdbench/cli/talk.h>
#include <lmdbench/experiment/stability_search.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

struct StabilityOptions {
  std::string experiment;
  std::vector<std::string> overrides;
  bool json = false;
};

void search(const StabilityOptions& options) {
  const Experiment experiment = load_experiment(options.experiment, options.overrides);
  ProgressBar bar(progress_welcome());
  const std::vector<StabilityRow> rows = find_critical_stiffness(
      experiment, [&bar](const std::string& phase, std::int64_t done, std::int64_t total) {
        bar.update(phase, done, total);
        return true;
      });
  bar.wipe();
  fmt::print("{}{}", options.json ? stability_json(rows) : stability_text(rows), options.json ? "\n" : "");
}

}  // namespace

void add_stability_command(CLI::App& app) {
  auto* command = app.add_subcommand("stability", "Find the largest clean stiffness of a closed loop");
  const auto options = std::make_shared<StabilityOptions>();
  command->add_option("experiment", options->experiment, "experiment file (JSON) whose loop is closed")
      ->required();
  command->add_option("--set", options->overrides, "override a value: /json/pointer=value; repeatable")
      ->allow_extra_args(false);
  command->add_flag("--json", options->json, "a JSON array, one object a method");
  command->callback([options] { search(*options); });
}

}  // namespace lmdbench
