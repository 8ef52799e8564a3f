// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>
#include <study/worlds/completeness.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace lmdbench::worlds {

completeness::Judgement judge_world(const World& world, double cutoff,
                                    const std::function<void(const std::string&)>& complain) {
  Scene scene = world.scene;
  scene.cutoff = cutoff;
  const auto certified = make_method("certified", scene), exhaustive = make_method("exhaustive", scene);
  completeness::Judgement judgement;
  for (std::size_t frame = 0; frame < world.poses.size(); ++frame) {
    const Pose& pose = world.poses[frame];
    const LmdSet found = lmds_at(*certified, pose), truth = lmds_at(*exhaustive, pose);
    std::string objection;
    judgement += completeness::judge(truth, found, scene, 1.0, objection);
    if (objection.empty()) continue;
    complain(fmt::format("frame {} at {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}: {}", frame,
                         pose.translation.x(), pose.translation.y(), pose.translation.z(), pose.rotation.x(),
                         pose.rotation.y(), pose.rotation.z(), pose.rotation.w(), objection));
  }
  return judgement;
}

completeness::Judgement judge_play(const Play& play, double cutoff,
                                   const std::function<void(const std::string&)>& complain) {
  const auto poses = std::make_shared<std::vector<Pose>>(play.movers.size());
  const Scene scene{play.movers.front(), play.standing, cutoff, play.movers, 0, poses};
  const auto certified = make_method("certified", scene), exhaustive = make_method("exhaustive", scene);
  // Each mover with all of a higher number; `Lmd::fixed_body` counts from the first of those.
  std::vector<Scene> scenes;
  for (std::size_t mover = 0; mover < scene.mover_count(); ++mover) {
    scenes.push_back({scene.body(mover), {}, cutoff});
    for (std::size_t other = mover + 1; other < scene.object_count(); ++other)
      scenes.back().fixed.emplace_back(scene.body(other));
  }
  const auto of_mover = [&](const LmdSet& all, std::size_t mover) {
    LmdSet own;
    for (Lmd lmd : all) {
      const ObjectPair pair = ObjectPair::of(lmd.fixed_body, scene);
      if (pair.mover != mover) continue;
      lmd.fixed_body = static_cast<std::int32_t>(pair.other - mover - 1);
      own.push_back(lmd);
    }
    return own;
  };
  completeness::Judgement judgement;
  for (std::size_t frame = 0; frame < play.frames.size(); ++frame) {
    *poses = play.frames[frame];
    const LmdSet found = lmds_at(*certified, poses->front());
    const LmdSet truth = lmds_at(*exhaustive, poses->front());
    completeness::Judgement of_frame;
    for (std::size_t mover = 0; mover < scenes.size(); ++mover) {
      std::string objection;
      of_frame +=
          completeness::judge(of_mover(truth, mover), of_mover(found, mover), scenes[mover], 1.0, objection);
      if (!objection.empty()) complain(fmt::format("frame {}, mover {}: {}", frame, mover, objection));
    }
    of_frame.poses = 1;
    of_frame.wrong_poses = std::min<std::size_t>(of_frame.wrong_poses, 1);
    judgement += of_frame;
  }
  return judgement;
}

}  // namespace lmdbench::worlds
