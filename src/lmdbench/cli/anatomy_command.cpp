// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/cli/commands.h>
#include <lmdbench/cli/experiment_argument.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/prepare/load_scene.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/view/anatomy.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace lmdbench {
namespace {

/// The first frame at or after a time; unset: the middle of the frames in contact, or of all.
std::size_t frame_at(const PreparedRun& prepared, std::optional<double> time) {
  const std::vector<double>& times = prepared.times;
  if (time) {
    if (!(*time >= times.front() && *time <= times.back()))
      throw UsageError("", "--time", fmt::format("{} s is no time of the path", *time),
                       fmt::format("give one from {} to {}", times.front(), times.back()));
    const auto later = std::lower_bound(times.begin(), times.end(), *time);
    return static_cast<std::size_t>(later - times.begin());
  }
  const std::vector<bool> in_contact =
      frames_in_contact(prepared.scene(), prepared.input.motion, prepared.input.poses);
  std::vector<std::size_t> touched;
  for (std::size_t frame = 0; frame < in_contact.size(); ++frame)
    if (in_contact[frame]) touched.push_back(frame);
  return touched.empty() ? times.size() / 2 : touched[touched.size() / 2];
}

}  // namespace

void add_anatomy_command(CLI::App& app) {
  struct Options {
    ExperimentArgument experiment;
    std::optional<double> time;
    std::vector<int> levels{2, 5, 8};
  };
  auto* command = app.add_subcommand(
      "anatomy",
      "Print, as JSON, what the parts of the paper's algorithms see at one pose (of more than two meshes: "
      "the "
      "nearest pair, in the frame of its second mesh): levels of the hierarchy, a node "
      "pair for each verdict of G1 to G3, neighbourhoods of local tracking, the visibility pre-test");
  const auto options = std::make_shared<Options>();
  add_experiment_argument(*command, options->experiment)->required();
  command->add_option("--time", options->time,
                      "time of the path [s]; without it the middle one of the frames in contact");
  command
      ->add_option("--level", options->levels,
                   "levels of the moving mesh's hierarchy; nodes of the last one are tested")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  command->callback([options] {
    const Experiment experiment = options->experiment.load();
    const PreparedRun prepared = prepare(experiment, {}, Deforming::FOLLOWED);
    const std::size_t frame = frame_at(prepared, options->time);
    SceneFrames bodies(prepared.scene(), prepared.input.motion);
    bodies.to_frame(static_cast<std::int64_t>(frame));
    Scene scene = bodies.scene();
    Pose pose = prepared.input.poses[frame];
    if (!scene.is_pair()) {
      // The nearest pair, in the frame of its second mesh.
      const ObjectPair pair = NearestObjects(bodies.scene()).at(pose).objects;
      pose = relative_pose(scene.pose(pair.other, pose), scene.pose(pair.mover, pose));
      scene = pair.scene_of(bodies.scene());
    }
    fmt::print("{}\n", anatomy_json(scene, pose, prepared.times[frame], options->levels));
  });
}

}  // namespace lmdbench
