// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>
#include <lmdbench/scene/mover_group.h>

#include <fmt/format.h>
#include <study/worlds/completeness.h>

#include <algorithm>
#include <map>
#include <utility>

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

completeness::Judgement judge_play(const Play& play, double cutoff,
                                   const std::function<void(const std::string&)>& complain) {
  MoverGroup group(play.movers, play.standing, cutoff, method_maker("certified"));
  const std::size_t movers = play.movers.size(), objects = movers + play.standing.size();
  const auto body_of = [&](std::size_t object) {
    return object < movers ? play.movers[object] : play.standing[object - movers].body;
  };
  // Each mover with all that has a higher number; `Lmd::fixed_body` counts from the first of those.
  std::vector<Scene> scenes;
  for (std::size_t mover = 0; mover < movers; ++mover) {
    scenes.push_back({play.movers[mover], {}, cutoff});
    for (std::size_t other = mover + 1; other < objects; ++other)
      scenes.back().fixed.emplace_back(body_of(other));
  }
  std::map<std::pair<const Body*, const Body*>, MeshPair> pairs;
  const auto make = method_maker("exhaustive");
  completeness::Judgement judgement;
  MoverContacts contacts;
  MoverGroup::Work work;
  WorkCounters ignored;
  LmdSet of_pair;
  for (std::size_t frame = 0; frame < play.frames.size(); ++frame) {
    const std::vector<Pose>& poses = play.frames[frame];
    const auto pose_of = [&](std::size_t object) {
      return object < movers ? poses[object] : play.standing[object - movers].X_WF;
    };
    group.search(poses, contacts, work);
    completeness::Judgement of_frame;
    for (std::size_t mover = 0; mover < movers; ++mover) {
      LmdSet truth, found;
      const auto& sphere = play.movers[mover]->prepared<MeshBounds>();
      for (std::size_t other = mover + 1; other < objects; ++other) {
        const auto& beside = body_of(other)->prepared<MeshBounds>();
        const double between = (RigidTransform(poses[mover]).point(sphere.centre) -
                                RigidTransform(pose_of(other)).point(beside.centre))
                                   .norm();
        if (between > sphere.radius + beside.radius + cutoff + 1e-6) continue;
        MeshPair& pair = pairs
                             .try_emplace({play.movers[mover].get(), body_of(other).get()},
                                          Scene{play.movers[mover], {body_of(other)}, cutoff}, make)
                             .first->second;
        const PlacedPair place = pair.placed(pose_of(other), poses[mover]);
        pair.shared().search(place.X_FM, of_pair, ignored);
        for (Lmd& lmd : of_pair) {
          place.to_world(lmd, static_cast<std::uint32_t>(other - mover - 1));
          truth.push_back(lmd);
        }
      }
      for (const MoverContacts::Pair& pair : contacts.pairs) {
        if (pair.mover != mover) continue;
        for (Lmd lmd : contacts.of(pair)) {
          lmd.fixed_body = static_cast<std::int32_t>(pair.other - mover - 1);
          found.push_back(lmd);
        }
      }
      std::string objection;
      of_frame += completeness::judge(truth, found, scenes[mover], 1.0, objection);
      if (!objection.empty()) complain(fmt::format("frame {}, mover {}: {}", frame, mover, objection));
    }
    of_frame.poses = 1;
    of_frame.wrong_poses = std::min<std::size_t>(of_frame.wrong_poses, 1);
    judgement += of_frame;
  }
  return judgement;
}

}  // namespace lmdbench::worlds
