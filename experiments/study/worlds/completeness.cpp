// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>

#include <fmt/format.h>
#include <study/worlds/completeness.h>

namespace lmdbench::worlds {

completeness::Judgement judge_world(const World& world, double cutoff,
                                    const std::function<void(const std::string&)>& complain) {
  Scene scene = world.scene;
  scene.cutoff = cutoff;
  const auto certified = make_method("certified", scene), exhaustive = make_method("exhaustive", scene);
  completeness::Judgement judgement;
  LmdSet found, truth;
  WorkCounters ignored;
  for (std::size_t frame = 0; frame < world.poses.size(); ++frame) {
    const Pose& pose = world.poses[frame];
    certified->search(pose, found, ignored);
    exhaustive->search(pose, truth, ignored);
    std::string objection;
    judgement += completeness::judge(truth, found, scene, 1.0, objection);
    if (objection.empty()) continue;
    complain(fmt::format("frame {} at {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}: {}", frame,
                         pose.translation.x(), pose.translation.y(), pose.translation.z(), pose.rotation.x(),
                         pose.rotation.y(), pose.rotation.z(), pose.rotation.w(), objection));
  }
  return judgement;
}

}  // namespace lmdbench::worlds
