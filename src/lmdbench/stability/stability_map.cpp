// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/statistics.h>
#include <lmdbench/drivers/contact_finder.h>
#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/metrics/cleanliness.h>
#include <lmdbench/metrics/contact_work.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/stability/stability_map.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <span>

namespace lmdbench {
namespace {

/// Force of the exact set at a pose, under the profile's aggregation.
Wrench exact_wrench(const Scene& scene, ForceProfile profile, const Aggregation& aggregation, ForceLaw law,
                    const Pose& X_WM) {
  profile.law = law;
  return ContactFinder(aggregation, scene)
      .wrench_at(*make_method("certified", scene), X_WM, profile, X_WM.translation);
}

/// Sine of one axis.
struct Tremor {
  double frequency_hz = 0.0;
  double phase = 0.0;
};

std::array<Tremor, 3> draw_tremor(std::int64_t seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::array<Tremor, 3> tremor;
  for (Tremor& axis : tremor) {
    axis.frequency_hz = 8.0 + 4.0 * uniform_number(random);
    axis.phase = 2.0 * std::numbers::pi * uniform_number(random);
  }
  return tremor;
}

std::vector<Pose> meant_path(const std::vector<Pose>& path, std::int64_t frames, double rate,
                             const Vec3& press_W, double tremor_m, std::int64_t seed) {
  const std::array<Tremor, 3> tremor = draw_tremor(seed);
  std::vector<Pose> meant;
  meant.reserve(static_cast<std::size_t>(frames));
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    Pose pose = path[std::min(static_cast<std::size_t>(frame), path.size() - 1)];
    const double time = static_cast<double>(frame) / rate;
    const double s = std::min(time / PRESS_S, 1.0);
    const double eased = s * s * (3.0 - 2.0 * s);
    pose.translation += eased * press_W;
    for (int axis = 0; axis < 3; ++axis) {
      const Tremor& t = tremor[static_cast<std::size_t>(axis)];
      pose.translation[axis] +=
          eased * tremor_m * std::sin(2.0 * std::numbers::pi * t.frequency_hz * time + t.phase);
    }
    meant.push_back(pose);
  }
  return meant;
}

/// What the held mesh may touch: other movers rest at their first pose.
Scene standing(Scene scene) {
  for (std::size_t i = 0; i < scene.movers.size(); ++i)
    if (i != scene.held) scene.fixed.emplace_back(scene.movers[i], (*scene.mover_poses)[i]);
  scene.movers.clear();
  scene.held = 0;
  return scene;
}

void measure(StabilityMapRun& run, const MethodRecord& record, const ContactPorts& ports, const Scene& scene,
             double rate) {
  const auto settled = static_cast<std::size_t>(SETTLED_S * rate);
  const std::size_t frames = record.frames.size();
  Swing swing;
  swing.period_s = 1.0 / rate;
  std::vector<double> stiffness, force;
  for (std::size_t i = settled; i < frames; ++i) {
    const FrameRecord& frame = record.frames[i];
    const Vec3& before = record.frames[i - 1].force;
    swing.position_W.push_back(record.loop[i].position - record.loop[settled].position);
    swing.velocity_W.push_back(record.loop[i].velocity);
    swing.force_W.push_back(frame.force);
    stiffness.push_back(frame.effective_stiffness);
    force.push_back(frame.force.norm());
    if ((frame.force - before).norm() > JUMP_LOAD * LOAD_N) ++run.jumps;
    if (frame.force.isZero(0.0) && !before.isZero(0.0)) ++run.dropouts;
  }
  Vec3 mean_place = Vec3::Zero();
  for (const Vec3& position : swing.position_W) mean_place += position;
  mean_place /= static_cast<double>(swing.position_W.size());
  double spread = 0.0;
  for (const Vec3& position : swing.position_W) spread += (position - mean_place).squaredNorm();
  run.amplitude_m = std::sqrt(spread / static_cast<double>(swing.position_W.size()));
  run.frequency_hz = judge(swing).frequency_hz;
  run.force_mean_n = mean(force);
  // The filter runs over the whole force, so that it is settled where measuring begins.
  std::vector<Vec3> all;
  for (const FrameRecord& frame : record.frames) all.push_back(frame.force);
  const std::vector<Vec3> high = above_30_hz(all, 1.0 / rate);
  double sum = 0.0;
  for (std::size_t i = settled; i < frames; ++i) sum += high[i].squaredNorm();
  run.force_above_30_hz_n = std::sqrt(sum / static_cast<double>(frames - settled));
  run.effective_stiffness_p99_n_per_m = quantile(stiffness, P99);
  // Where the device is, not what its encoders tell.
  std::vector<Pose> poses;
  for (std::size_t i = settled; i < frames; ++i)
    poses.push_back({record.loop[i].position, record.loop[i].orientation});
  const Clearance distances = clearance(scene, poses);
  run.clearance_m = distances.least_m;
  run.penetration_share = static_cast<double>(distances.touching) / static_cast<double>(frames - settled);
  const double seconds = static_cast<double>(frames - 1 - settled) / rate;
  if (const std::vector<double> work = contact_work(record, ports); !work.empty())
    run.power_created_w = (work.back() - work[settled]) / seconds;
  run.balance_error = record.loop.back().energy.balance_error();
}

}  // namespace

void map_stability(const Experiment& experiment, const StabilityMapGrid& grid,
                   const std::function<bool(const StabilityMapRun&)>& sink) {
  const LoopChoice& loop = experiment.loop;
  const std::string file = experiment.file.string();
  if (!loop.closed)
    throw UsageError(file, "/loop/kind", "the loop is open, so nothing can shake", "set it to closed");
  if (!loop.dynamics.hand || !(loop.dynamics.hand->stiffness_n_per_m > 0.0))
    throw UsageError(file, "/loop/hand", "no hand with a spring presses the device",
                     "name one, such as postural-arm");
  const double rate = experiment.frame_rate_hz;
  if (rate <= 2.0 * HIGH_PASS_HZ)
    throw UsageError(file, "/frame_rate_hz", "too slow to tell what of the force is above 30 Hz",
                     fmt::format("give more than {:g} Hz", 2.0 * HIGH_PASS_HZ));
  if (static_cast<double>(grid.frames) < (SETTLED_S + 0.2) * rate)
    throw UsageError(file, "/frames", "too few frames to settle and to be measured",
                     "give 0.7 seconds or more");
  PreparedRun prepared = prepare(experiment, {}, Deforming::FOLLOWED);
  hold_first_frame(prepared);
  const Pose& start = prepared.input.poses.front();
  const std::vector<DrivenMethod> methods = driven_methods(experiment, prepared);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const MethodChoice& choice = experiment.methods[m];
    const PreparedProfile& profile = prepared.profiles[choice.profile];
    const Scene scene = standing(profile.scene);
    const Wrench at_start =
        exact_wrench(profile.scene, profile.force, *experiment.profiles[choice.profile].aggregation,
                     choice.force_law, start);
    if (!(at_start.stiffness > 0.0 && at_start.force.norm() > 0.0))
      throw UsageError(file, "/path/file", "its first pose is not in contact",
                       "begin where there is force and stiffness");
    const Vec3 press_W = -at_start.force.normalized() * LOAD_N / loop.dynamics.hand->stiffness_n_per_m;
    const bool ages = methods[m].make()->description().tracks_locally;
    for (const std::int64_t age : ages ? grid.ages_frames : std::vector<std::int64_t>{0}) {
      DriverChoice driver = experiment.driver;
      driver.repetitions = 1;
      driver.block_frames = grid.frames;
      driver.search_every_frames = std::max<std::int64_t>(age, 1);
      driver.search_latency_frames = age;
      for (const double stiffness : grid.stiffness_n_per_m) {
        DrivenMethod scaled = methods[m];
        scaled.profile.scale_force(stiffness / at_start.stiffness);
        for (std::int64_t seed = 1; seed <= grid.seeds; ++seed) {
          StabilityMapRun run;
          run.method = choice.entry;
          run.profile = profile.name;
          run.age_frames = age;
          run.stiffness_n_per_m = stiffness;
          run.seed = seed;
          DriverInput input = prepared.input;
          input.poses = meant_path(prepared.input.poses, grid.frames, rate, press_W,
                                   TREMOR_CUTOFF * profile.force.cutoff, seed);
          input.frames = grid.frames;
          input.loop = loop;
          const MethodRecord record = run_lockstep({scaled}, input, driver, {}).front();
          measure(run, record, contact_ports(input), scene, rate);
          if (!sink(run)) return;
        }
      }
    }
  }
}

std::string stability_map_json(const std::string& scene, const StabilityMapRun& run) {
  return nlohmann::ordered_json{{"scene", scene},
                                {"method", run.method},
                                {"profile", run.profile},
                                {"age_frames", run.age_frames},
                                {"stiffness_n_per_m", run.stiffness_n_per_m},
                                {"seed", run.seed},
                                {"amplitude_m", run.amplitude_m},
                                {"frequency_hz", run.frequency_hz},
                                {"force_mean_n", run.force_mean_n},
                                {"force_above_30_hz_n", run.force_above_30_hz_n},
                                {"effective_stiffness_p99_n_per_m", run.effective_stiffness_p99_n_per_m},
                                {"clearance_m", run.clearance_m},
                                {"penetration_share", run.penetration_share},
                                {"power_created_w", run.power_created_w},
                                {"jumps", run.jumps},
                                {"dropouts", run.dropouts},
                                {"balance_error", run.balance_error},
                                {"shaking", run.shaking()},
                                {"through", run.through()},
                                {"clean", run.clean()}}
      .dump();
}

}  // namespace lmdbench
