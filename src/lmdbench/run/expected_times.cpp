// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>
#include <lmdbench/run/expected_times.h>

#include <algorithm>
#include <chrono>

namespace lmdbench {
namespace {

/// Mean seconds of a search at frames spread over the path, each at its shape.
/// @param mover_poses of several movers, which `play` has
double search_seconds(Method& method, DeformingScene& bodies, const std::vector<Pose>& poses,
                      const MoverPlay* play, std::vector<Pose>& mover_poses) {
  const auto count = static_cast<std::int64_t>(poses.size());
  const std::int64_t samples = std::min(TIMED_FRAMES, count);
  const auto begin = std::chrono::steady_clock::now();
  for (std::int64_t k = 0; k < samples; ++k) {
    LmdSet lmds;
    WorkCounters counters;
    const std::int64_t frame = (2 * k + 1) * count / (2 * samples);
    bodies.to_frame(frame);
    if (play != nullptr) mover_poses = play->poses[static_cast<std::size_t>(frame)];
    method.search(poses[static_cast<std::size_t>(frame)], lmds, counters);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() /
         static_cast<double>(samples);
}

}  // namespace

std::vector<ExpectedTime> expected_times(const Experiment& experiment, const PreparedRun& prepared) {
  const auto frames = static_cast<double>(prepared.input.poses.size());
  const MoverPlay* play = prepared.input.movers.get();
  const auto mover_poses = std::make_shared<std::vector<Pose>>();
  const auto make = [&](const std::string& name, const Scene& scene, const nlohmann::json& options) {
    return play != nullptr ? make_among_movers(play->scene(scene.cutoff), mover_poses,
                                               method_description(name), method_maker(name, options))
                           : make_method(name, scene, options);
  };
  std::vector<ExpectedTime> times;
  for (const MethodChoice& choice : experiment.methods) {
    DeformingScene bodies(prepared.profiles[choice.profile].scene, prepared.input.deformation);
    const auto method = make(choice.name, bodies.scene(), choice.options);
    // Where meshes deform the local update makes the method anew, which costs as much as a search.
    const double searches = method->description().tracks_locally && !bodies.deforms()
                                ? frames / static_cast<double>(experiment.driver.search_every_frames)
                                : frames;
    times.push_back(
        {choice.label, static_cast<double>(experiment.driver.repetitions) * searches *
                           search_seconds(*method, bodies, prepared.input.poses, play, *mover_poses)});
  }
  if (const std::int64_t stride = experiment.probe_stride("truth"); stride > 0) {
    DeformingScene bodies(prepared.scene(), prepared.input.deformation);
    const auto truth = make("exhaustive", bodies.scene(), nlohmann::json::object());
    // Two searches a probed frame: the next frame's force tells the true jump.
    times.push_back({"truth", 2.0 * frames / static_cast<double>(stride) *
                                  search_seconds(*truth, bodies, prepared.input.poses, play, *mover_poses)});
  }
  return times;
}

}  // namespace lmdbench
