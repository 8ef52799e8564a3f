// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/progress_bar.h>
#include <lmdbench/cli/stop_signals.h>
#include <lmdbench/cli/talk.h>
#include <lmdbench/sweep/run_sweep.h>
#include <lmdbench/sweep/write_sweep.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

struct SweepOptions {
  std::string sweep;
  std::string out;
  std::vector<std::string> overrides;
  bool json = false;
};

void sweep_to_file(const SweepOptions& options, const std::vector<std::string>& argv) {
  const Sweep sweep = load_sweep(options.sweep, options.overrides);
  const std::filesystem::path out = options.out.empty() ? "results/" + sweep.name + ".h5" : options.out;
  ProgressBar bar(progress_welcome());
  heed_stop_signals();
  try {
    const SweepResult result = run_sweep_to_file(
        sweep, out, argv, [&bar](const std::string& phase, std::int64_t done, std::int64_t total) {
          bar.update(phase, done, total);
          return !stop_requested();
        });
    bar.wipe();
    fmt::print("{}{}", options.json ? sweep_json(sweep, result) : sweep_text(sweep, result),
               options.json ? "\n" : "");
    if (result.resumed_runs > 0)
      spdlog::info("{} of {} traversals were done before: {}", result.resumed_runs,
                   sweep.repetitions * std::ssize(sweep.points), journal_of(out).string());
    spdlog::info("wrote {}", out.string());
  } catch (const Interrupted&) {
    bar.wipe();
    spdlog::error("interrupted: the points that are done stay in {}; the same command goes on from there",
                  journal_of(out).string());
    end_by_the_signal();
  }
}

}  // namespace

void add_work_precision_command(CLI::App& app, const std::vector<std::string>& argv) {
  auto* command =
      app.add_subcommand("work-precision", "Sweep options: error against run time, point by point");
  const auto options = std::make_shared<SweepOptions>();
  command->add_option("sweep", options->sweep, "sweep file (JSON; experiments/schema/sweep.schema.json)")
      ->required();
  command->add_option("--out,-o", options->out, "result file; results/<name>.h5 without it");
  command
      ->add_option("--set", options->overrides,
                   "override a value of the sweep: /json/pointer=value; repeatable")
      ->allow_extra_args(false);
  command->add_flag("--json", options->json, "a JSON array, one object a point");
  command->callback([options, argv] { sweep_to_file(*options, argv); });
}

}  // namespace lmdbench
