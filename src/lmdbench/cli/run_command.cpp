// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/plain_name.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/experiment_argument.h>
#include <lmdbench/cli/progress_bar.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/metrics/summary.h>
#include <lmdbench/result/run_to_file.h>
#include <lmdbench/result/write_result.h>
#include <lmdbench/run/run.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

struct RunOptions {
  ExperimentArgument experiment;
  std::string out;
  bool names_out = false;
  std::string driver;
  bool json = false;
  bool resume = false;
  bool require_realtime = false;
};

void run_to_file(const RunOptions& options, const std::vector<std::string>& argv) {
  ExperimentArgument argument = options.experiment;
  std::vector<Override>& overrides = argument.overrides;
  const std::string kind = options.require_realtime ? "realtime" : options.driver;
  if (!options.driver.empty()) overrides.push_back("/driver/kind=" + options.driver);
  if (std::ranges::any_of(overrides, [&](const Override& set) {
        return set.starts_with("/driver/kind=") && set.find(kind) == std::string::npos;
      }))
    throw UsageError(argument.file, "/driver/kind", "the command line asks for two drivers",
                     "keep one of --driver, --require-realtime and --set /driver/kind=...");
  if (options.require_realtime)
    overrides.insert(overrides.end(), {"/driver/kind=realtime", "/driver/realtime/required=true"});
  const Experiment experiment = argument.load();
  const std::filesystem::path out = options.names_out ? options.out : "results/" + experiment.name + ".h5";

  ProgressBar bar(talk_welcome());
  heed_stop_signals();
  try {
    const RunResult result = run_experiment_to_file(experiment, out, argv, std::ref(bar),
                                                    options.resume ? Leftover::RESUME : Leftover::REFUSE);
    bar.wipe();
    if (result.resumed_frames > 0)
      spdlog::info("the times of {} frames are those of the interrupted run", result.resumed_frames);
    const RunSummary summary = summarise(experiment, result);
    // The table has them already; JSON has them for programs alone.
    if (options.json)
      for (const std::string& warning : summary.warnings) spdlog::warn("{}", warning);
    for (const Track& track : result.tracks) {
      if (track.fcl() == nullptr) continue;
      for (const FclException& e : track.fcl()->exceptions)
        spdlog::debug(
            "frame {}: {} {:.17g} m, FCL {:.17g} m, exact {:.17g} m; position {:.17g} {:.17g} {:.17g}, "
            "orientation xyzw {:.17g} {:.17g} {:.17g} {:.17g}; FCL's triangles {} and {} of fixed mesh {}",
            e.frame, e.who, e.distance, e.fcl_distance, e.lmdbench_distance, e.pose.translation.x(),
            e.pose.translation.y(), e.pose.translation.z(), e.pose.rotation.x(), e.pose.rotation.y(),
            e.pose.rotation.z(), e.pose.rotation.w(), e.triangle_moving, e.triangle_fixed, e.fixed_body);
    }
    if (options.json) {
      nlohmann::ordered_json json = nlohmann::ordered_json::parse(summary_json(summary));
      if (!result.clocks.empty()) json["realtime"] = realtime_json(result.clocks);
      fmt::print("{}\n", json.dump(2));
    } else if (talk_welcome()) {
      fmt::print("{}{}",
                 spdlog::should_log(spdlog::level::debug) ? summary_text(summary) : summary_table(summary),
                 realtime_text(result.clocks));
    }
    const std::string page = (out.parent_path() / out.stem()).string();
    spdlog::info("wrote {}; tables, plots and a 3D view: lmdbench report {} --out {}", out.string(),
                 shell_word(out.string()), shell_word(page));
    if (!summary.broken_limits.empty())
      throw Error(
          ExitCode::CHECK_FAILED, argument.file, "/limits",
          fmt::format("{} broken: {}", summary.broken_limits.size(), fmt::join(summary.broken_limits, "; ")),
          "the result is written: look there, or move the limits");
  } catch (const Interrupted&) {
    bar.wipe();
    const std::string part = out.string() + ".part";
    spdlog::error("interrupted: {}; an earlier {} is as it was",
                  std::filesystem::exists(part)
                      ? part + " keeps what was measured (remedy: go on with --resume, or remove it)"
                      : "nothing was measured yet",
                  out.string());
    end_by_the_signal();
  }
}

}  // namespace

void add_run_command(CLI::App& app, const std::vector<std::string>& argv) {
  auto* command = app.add_subcommand("run", "Run an experiment and write its result file");
  const auto options = std::make_shared<RunOptions>();
  add_experiment_argument(*command, options->experiment)->required();
  CLI::Option* out =
      command->add_option("--out,-o", options->out, "result file; results/<name>.h5 without it");
  command->add_option("--driver", options->driver, "same as --set /driver/kind=...");
  command->add_flag(
      "--require-realtime", options->require_realtime,
      "on the clock, and an error where the system refuses a core, a priority or locked memory");
  command->add_flag("--json", options->json, "summary as JSON");
  command->add_flag("--resume", options->resume,
                    "go on with what an interrupted run of the same experiment left, if anything");
  command->footer(fmt::format("{}\n{}", methods_help(), command->get_footer()));
  command->callback([options, argv, out] {
    options->names_out = out->count() > 0;
    run_to_file(*options, argv);
  });
}

}  // namespace lmdbench
