// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/progress_bar.h>
#include <lmdbench/sweep/run_sweep.h>
#include <lmdbench/sweep/sweep_parts.h>
#include <lmdbench/sweep/write_sweep.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

struct SweepOptions {
  std::string sweep;
  std::string out;
  std::string points;
  std::vector<std::string> overrides;
  bool json = false;
  bool list = false;
  bool collect = false;
  bool names_out = false;
  bool names_points = false;
};

void print_points(const Sweep& sweep, const std::filesystem::path& out, bool json) {
  fmt::print("{}{}", json ? point_list_json(sweep, out) : point_list_text(sweep, out), json ? "\n" : "");
}

void measure_points(const SweepOptions& options, const Sweep& sweep, const std::filesystem::path& out,
                    ProgressBar& bar, int& exit_status) {
  const std::vector<std::size_t> points =
      parse_point_numbers(options.points, sweep.points.size(), "--points");
  const SweepWork work = measure_part(sweep, points, out, std::ref(bar));
  for (const auto& [point, why] : work.failures) spdlog::error("point {} has no numbers: {}", point, why);
  if (!work.failures.empty()) exit_status = static_cast<int>(ExitCode::CHECK_FAILED);
  spdlog::info("{} of {} traversals were done before; the entries are in {}", work.resumed_runs,
               sweep.repetitions * std::ssize(points), parts_folder(out).string());
}

void measure_or_collect(const SweepOptions& options, const Sweep& sweep, const std::filesystem::path& out,
                        const std::vector<std::string>& argv, ProgressBar& bar, int& exit_status) {
  const SweepResult result = options.collect ? collect_sweep_to_file(sweep, out, argv)
                                             : run_sweep_to_file(sweep, out, argv, std::ref(bar));
  bar.wipe();
  if (options.json)
    fmt::print("{}\n", sweep_json(sweep, result));
  else if (talk_welcome())
    fmt::print("{}", sweep_text(sweep, result));
  for (const std::string& line : done_again(sweep, out)) spdlog::info("done again: {}", line);
  if (result.resumed_runs > 0)
    spdlog::info("{} of {} traversals were done before: {}", result.resumed_runs,
                 sweep.repetitions * std::ssize(sweep.points), journal_of(out).string());
  spdlog::info("wrote {}", out.string());
  std::vector<std::size_t> failed;
  for (std::size_t i = 0; i < result.points.size(); ++i)
    if (!result.points[i].failure.empty()) failed.push_back(i);
  if (failed.empty()) return;
  spdlog::error("{} of {} points have no numbers: {}; the first: {}", failed.size(), result.points.size(),
                point_numbers_text(failed), result.points[failed.front()].failure);
  exit_status = static_cast<int>(ExitCode::CHECK_FAILED);
}

void sweep_to_file(const SweepOptions& options, const std::vector<std::string>& argv, int& exit_status) {
  const Sweep sweep = load_sweep(options.sweep, options.overrides);
  const std::filesystem::path out = options.names_out ? options.out : "results/" + sweep.name + ".h5";
  if (options.list) return print_points(sweep, out, options.json);
  ProgressBar bar(talk_welcome());
  heed_stop_signals();
  try {
    if (options.names_points)
      measure_points(options, sweep, out, bar, exit_status);
    else
      measure_or_collect(options, sweep, out, argv, bar, exit_status);
  } catch (const Interrupted&) {
    bar.wipe();
    spdlog::error("interrupted: the points that are done stay in {}; the same command goes on from there",
                  (options.names_points ? parts_folder(out) : journal_of(out)).string());
    end_by_the_signal();
  }
}

}  // namespace

void add_work_precision_command(CLI::App& app, const std::vector<std::string>& argv, int& exit_status) {
  auto* command =
      app.add_subcommand("work-precision", "Sweep options: error against run time, point by point");
  const auto options = std::make_shared<SweepOptions>();
  command->add_option("sweep", options->sweep, "sweep file (JSON; experiments/schema/sweep.schema.json)")
      ->required();
  CLI::Option* out =
      command->add_option("--out,-o", options->out, "result file; results/<name>.h5 without it");
  command
      ->add_option("--set", options->overrides,
                   "override a value of the sweep: /json/pointer=value; repeatable")
      ->allow_extra_args(false);
  CLI::Option* json = command->add_flag("--json", options->json, "a JSON array, one object a point");
  CLI::Option* list =
      command->add_flag("--list", options->list, "only number the points, and say which are done");
  CLI::Option* points = command->add_option(
      "--points", options->points,
      "measure only these, as 0-3,7, into a journal of their own beside the result (scripts/cluster/)");
  CLI::Option* collect =
      command->add_flag("--collect", options->collect,
                        "measure nothing: the result of what is in journals, an error where points lack");
  list->excludes(points)->excludes(collect);
  points->excludes(collect)->excludes(json);
  command->footer("Exit codes: 0 every point has its numbers; 1 some failed: /points/failure says why.");
  command->callback([options, argv, out, points, &exit_status] {
    options->names_out = out->count() > 0;
    options->names_points = points->count() > 0;
    sweep_to_file(*options, argv, exit_status);
  });
}

}  // namespace lmdbench
