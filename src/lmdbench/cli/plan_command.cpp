// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/experiment_argument.h>
#include <lmdbench/cli/progress_bar.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/prepare/plan.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/prepare/scene_look.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <vector>

namespace lmdbench {

void add_plan_command(CLI::App& app) {
  struct PlanOptions {
    ExperimentArgument experiment;
    bool json = false;
    bool schema = false;
  };
  auto* command =
      app.add_subcommand("plan", "Say what an experiment needs, what is left out and why; run nothing");
  const auto options = std::make_shared<PlanOptions>();
  add_experiment_argument(*command, options->experiment);
  command->add_flag("--json", options->json, "JSON, with the experiment and all its defaults");
  command->add_flag(
      "--schema", options->schema,
      "print the JSON Schema of experiment files, with the options of every method, and no plan");
  command->footer(fmt::format("{}\n{}", methods_help(), command->get_footer()));
  command->callback([options] {
    if (options->schema) {
      fmt::print("{}\n", experiment_schema().dump(2));
      return;
    }
    if (options->experiment.file.empty())
      throw UsageError("", "plan", "no experiment file", "name one: lmdbench plan EXPERIMENT.json");
    const Experiment experiment = options->experiment.load();
    ProgressBar bar(talk_welcome());
    const PreparedRun prepared = prepare(
        experiment, [&bar](std::int64_t done, std::int64_t total) { return bar("path", done, total); },
        Deforming::FOLLOWED);
    Plan plan = make_plan(experiment);
    const std::vector<bool> in_contact =
        frames_in_contact(prepared.scene(), prepared.input.motion, prepared.input.poses);
    plan.scene = look_at(experiment, prepared, in_contact);
    plan.rules = decide_rules({experiment, prepared.input.poses, in_contact});
    plan.scene->times = expected_times(experiment, prepared);
    bar.wipe();
    if (options->json)
      fmt::print("{}\n", plan_json(plan, experiment));
    else
      fmt::print("{}", plan_text(plan, experiment));
  });
}

}  // namespace lmdbench
