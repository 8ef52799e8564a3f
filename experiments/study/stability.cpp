// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/stability/stability_map.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <study/studies.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

/// Runs of the stability maps, one JSON object a line, for scripts/figures/stability_map.py.
namespace lmdbench::study {
namespace {

struct StabilityChoice {
  std::vector<std::string> experiments;
  std::vector<std::string> overrides;
  StabilityMapGrid grid{{150, 500, 1500, 5000, 11000, 16000}, {0, 5, 20, 100}};
};

int map(const StabilityChoice& choice) {
  for (const std::string& file : choice.experiments) {
    const Experiment experiment = load_experiment(file, choice.overrides);
    map_stability(experiment, choice.grid, [&](const StabilityMapRun& run) {
      fmt::print("{}\n", stability_map_json(experiment.name, run));
      std::fflush(stdout);  // keeps the line if the rest is interrupted
      return true;
    });
  }
  return 0;
}

}  // namespace

void add_stability(CLI::App& app, Run& chosen) {
  auto* command =
      app.add_subcommand("stability", "Closed loops over stiffness and age of the LMD set: raw runs");
  const auto choice = std::make_shared<StabilityChoice>();
  command->option_defaults()->always_capture_default(false);
  command->add_option("experiments", choice->experiments, "experiment files whose loop is closed")
      ->required();
  command->add_option("--set", choice->overrides, "override a value: /json/pointer=value; repeatable")
      ->allow_extra_args(false);
  command->add_option("--stiffness", choice->grid.stiffness_n_per_m,
                      "K_eff of the exact set at the first pose, N/m");
  command->add_option("--ages", choice->grid.ages_frames,
                      "frames between searches, and until their sets arrive");
  command->add_option("--seeds", choice->grid.seeds, "tremors of the hand a point")
      ->check(CLI::PositiveNumber);
  command->add_option("--frames", choice->grid.frames, "frames a run");
  command->callback([choice, &chosen] { chosen.work = [choice] { return map(*choice); }; });
}

}  // namespace lmdbench::study
