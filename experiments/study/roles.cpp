// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/prepare/prepare.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <study/studies.h>
#include <support/context.h>
#include <support/program.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// Share of the processor of each role of the paper's section 5 in a closed loop: device loop (sum
/// of forces, clip, motion of the simulated device), local tracking, and global thread (searches
/// with the trackings after them). The device's motion is timed in the run. The driver does not
/// time the sum of forces: that is timed afterwards, on the run's LMD sets.
namespace lmdbench::study {
namespace {

struct RolesChoice {
  std::string experiment = "experiments/bunny-closed.json";
  std::string json;
  int repetitions = 5;
  std::vector<Override> sets;
};

template <typename Work>
double seconds_of(Work&& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Forwards to another source of poses and times every `render`.
class TimedPoses final : public PoseSource {
 public:
  TimedPoses(std::unique_ptr<PoseSource> source, std::vector<double>& seconds)
      : source_(std::move(source)), seconds_(seconds) {}

  const Pose& pose() const override { return source_->pose(); }
  std::optional<LoopFrame> render(const RenderedForce& rendered) override {
    std::optional<LoopFrame> moved;
    seconds_.push_back(seconds_of([&] { moved = source_->render(rendered); }));
    return moved;
  }

 private:
  std::unique_ptr<PoseSource> source_;
  std::vector<double>& seconds_;  ///< One per frame.
};

/// One method under one profile.
struct RoleRow {
  std::string label;
  std::vector<double> device, local;  ///< One per frame [s].
  double force = 0.0;                 ///< Sums and clips forces, part of `device` [s].
  double global = 0.0;                ///< Sum over the run [s].
  double seconds = 0.0;               ///< Simulated time.
  std::int64_t frames_with_force = 0;
};

double sum(const std::vector<double>& values) {
  double total = 0.0;
  for (const double value : values)
    if (value == value) total += value;  // NaN: no such stage
  return total;
}

RoleRow measure_roles(const DrivenMethod& method, DriverInput input, const DriverChoice& driver) {
  RoleRow row;
  row.label = method.label;
  input.make_poses = [&, device = input] {
    return std::make_unique<TimedPoses>(pose_source(device), row.device);
  };
  input.keep_lmds = [](std::int64_t) { return true; };
  const MethodRecord record = std::move(run_lockstep({method}, input, driver, {}).front());
  for (std::size_t frame = 0; frame < record.frames.size(); ++frame) {
    const LmdSet& lmds = record.lmds.at(static_cast<std::int64_t>(frame));
    const Vec3 reference_W = RigidTransform(record.poses[frame]).point(input.reference_M);
    RenderedForce rendered;
    const double seconds = seconds_of([&] {
      rendered =
          input.device.render(sum_forces(lmds, method.profile, reference_W), method.profile.largest_sum);
    });
    row.device[frame] += seconds;
    row.force += seconds;
    if (rendered.force != record.frames[frame].force)
      throw Error(ExitCode::INTERNAL, "", method.label, "the summed force is not the rendered one",
                  "report this with the experiment file");
    row.frames_with_force += rendered.force.isZero(0.0) ? 0 : 1;
  }
  const RepetitionTimes& times = record.repetitions.front();
  row.local = times.local_update;
  row.global = sum(times.global_search) + sum(times.first_reduction) + sum(times.second_tracking);
  row.seconds = static_cast<double>(record.frames.size()) / input.frame_rate_hz;
  return row;
}

nlohmann::json described(const RoleRow& row) {
  std::vector<double> together(row.local);
  for (std::size_t i = 0; i < together.size(); ++i) together[i] += row.device[i];
  const auto stage = [](const std::vector<double>& values) {
    return nlohmann::json{{"median_s", median(values)},
                          {"p99_s", quantile(values, 0.99)},
                          {"maximum_s", *std::max_element(values.begin(), values.end())}};
  };
  return {{"label", row.label},
          {"seconds", row.seconds},
          {"frames_with_force", row.frames_with_force},
          {"device", stage(row.device)},
          {"local", stage(row.local)},
          {"together", stage(together)},
          {"together_above_1ms",
           std::count_if(together.begin(), together.end(), [](double value) { return value > 1e-3; })},
          {"device_share", sum(row.device) / row.seconds},
          {"force_share", row.force / row.seconds},
          {"local_share", sum(row.local) / row.seconds},
          {"global_share", row.global / row.seconds}};
}

void print_roles(const nlohmann::json& row) {
  const auto us = [&](const char* stage, const char* name) { return 1e6 * row[stage][name].get<double>(); };
  const auto ms = [&](const char* name) { return 1e3 * row[name].get<double>(); };
  fmt::print(
      "| {} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {} | "
      "{} |\n",
      row["label"].get<std::string>(), ms("device_share"), ms("force_share"), ms("local_share"),
      ms("global_share"), us("device", "median_s"), us("device", "p99_s"), us("device", "maximum_s"),
      us("together", "median_s"), us("together", "p99_s"), us("together", "maximum_s"),
      row["together_above_1ms"].get<int>(), row["frames_with_force"].get<int>());
}

int run_roles(const RolesChoice& choice) {
  const Experiment experiment = load_experiment(choice.experiment, choice.sets);
  if (!experiment.loop.closed)
    throw UsageError(choice.experiment, "/loop/kind", "an open loop",
                     "name an experiment in a closed loop: in an open one there is no device");
  const PreparedRun prepared = prepare(experiment);
  DriverChoice driver = experiment.driver;
  driver.repetitions = 1;
  nlohmann::json rows = nlohmann::json::array();
  fmt::print(
      "| method and profile | device loop [ms/s] | of it sum and clip of the forces | local tracking [ms/s] "
      "| global thread [ms/s] | device "
      "loop, median [us] | "
      "99 % | largest | device and local, median [us] | 99 % | largest | above 1 ms | frames with force |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int repetition = 0; repetition < choice.repetitions; ++repetition)
    for (const DrivenMethod& method : driven_methods(experiment, prepared)) {
      rows.push_back(described(measure_roles(method, prepared.input, driver)));
      print_roles(rows.back());
    }
  experiments::write_report(
      choice.json,
      {{"context", experiments::run_context()}, {"experiment", experiment.name}, {"rows", rows}});
  return 0;
}

}  // namespace

void add_roles(CLI::App& app, Run& chosen) {
  auto choice = std::make_shared<RolesChoice>();
  CLI::App* command = app.add_subcommand(
      "roles", "what the device loop, local tracking and the global thread cost in a closed loop");
  command->add_option("--experiment", choice->experiment, "experiment in a closed loop");
  command->add_option("--set", choice->sets, "/json/pointer=value, a value of the experiment");
  command->add_option("--repetitions", choice->repetitions, "how often every method runs")
      ->check(CLI::Range(1, 1000));
  command->add_option("--json", choice->json, "file for the numbers");
  command->callback([choice, &chosen] { chosen.work = [choice] { return run_roles(*choice); }; });
}

}  // namespace lmdbench::study
