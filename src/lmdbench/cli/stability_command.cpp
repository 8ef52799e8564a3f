// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/experiment_argument.h>
#include <lmdbench/cli/progress_bar.h>
#include <lmdbench/cli/real_range.h>
#include <lmdbench/stability/stability_search.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

struct StabilityOptions {
  ExperimentArgument experiment;
  StabilityBudget budget;
  bool json = false;
};

/// @return whether every row has an answer
bool search(const StabilityOptions& options) {
  const Experiment experiment = options.experiment.load();
  ProgressBar bar(talk_welcome());
  const std::vector<StabilityRow> rows = find_critical_stiffness(experiment, std::ref(bar), options.budget);
  bar.wipe();
  fmt::print("{}{}", options.json ? stability_json(rows) : stability_text(rows), options.json ? "\n" : "");
  bool all = true;
  for (const StabilityRow& row : rows) {
    if (row.has_answer()) continue;
    all = false;
    spdlog::error("{}", advice(row));
  }
  return all;
}

}  // namespace

void add_stability_command(CLI::App& app, int& exit_status) {
  auto* command = app.add_subcommand("stability", "Find the largest clean stiffness of a closed loop");
  const auto options = std::make_shared<StabilityOptions>();
  add_experiment_argument(*command, options->experiment, "experiment file (JSON) whose loop is closed")
      ->required();
  command->add_flag("--json", options->json, "a JSON array, one object a method");
  command
      ->add_option("--seconds", options->budget.seconds, "a method's search ends after this time, undecided")
      ->check(real_range(CLI::PositiveNumber))
      ->capture_default_str();
  command->add_option("--trials", options->budget.trials, "and after this many closed loops")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->footer(
      "With Coulomb friction the answer is that of the tap in the table; `exact` is the linear loop without "
      "friction.\n"
      "Exit codes: 0 every row has a stiffness; 3 one has none: no_contact, saturated, gives_way, stuck, "
      "within_counts, "
      "never or "
      "undecided, with the remedy on "
      "standard error.");
  command->callback([options, &exit_status] {
    if (!search(*options)) exit_status = static_cast<int>(ExitCode::INPUT_DATA);
  });
}

}  // namespace lmdbench
