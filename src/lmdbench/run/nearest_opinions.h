// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/crosscheck/fcl_crosscheck.h>
#include <lmdbench/run/mover_play.h>
#include <lmdbench/snch/minimum_distance.h>
#include <lmdbench/world/broad_phase.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

/// Which pair of a scene is the nearest one: FCL's opinion, and that of the exact search.
namespace lmdbench {

/// FCL's nearest pair, in a world that of the instances one after the other, nearest boxes first, each at the relative pose that
/// methods see.
class FclMinimum {
 public:
  explicit FclMinimum(const Scene& scene) {
    if (scene.is_world()) {
      phase_.emplace(scene);
      for (const auto& mesh : phase_->meshes())
        checks_.emplace_back(scene.moving->surface(), std::vector<const Surface*>{&mesh->surface()});
      return;
    }
    std::vector<const Surface*> fixed;
    for (const auto& body : scene.fixed) fixed.push_back(&body->surface());
    checks_.emplace_back(scene.moving->surface(), fixed);
  }

  FclResult at(const Pose& X_WM) const {
    if (!phase_) return checks_.front().distance(X_WM);
    FclResult best;
    phase_->by_distance(X_WM, [&](std::uint32_t instance, double bound) {
      if (best.fixed_body >= 0 && bound > best.distance) return false;
      const Pose& X_WF = phase_->pose_of(instance);
      const FclResult found = checks_[phase_->mesh_of(instance)].distance(relative_pose(X_WF, X_WM));
      const bool same = best.fixed_body >= 0 && found.distance == best.distance;
      if (best.fixed_body >= 0 && !(found.distance < best.distance) &&
          !(same && static_cast<std::int32_t>(instance) < best.fixed_body))
        return true;
      best = found;
      best.fixed_body = static_cast<std::int32_t>(instance);
      best.point_fixed = RigidTransform(X_WF).point(found.point_fixed);
      best.point_moving = RigidTransform(X_WF).point(found.point_moving);
      return true;
    });
    return best;
  }

 private:
  std::optional<BroadPhase> phase_;
  std::vector<FclCrosscheck> checks_;  ///< One a mesh of a world, else one of all.
};

/// Exact nearest pair with any of the fixed meshes, frame after frame.
class ExactMinimum {
 public:
  /// @param warm  whether a search begins with the last one's triangles
  ExactMinimum(const Scene& scene, bool warm) : scene_(scene), warm_(warm) {
    if (scene.is_world())
      phase_.emplace(scene);
    else
      start();
  }

  NearestInstance at(const Pose& X_WM) {
    if (phase_) return nearest_instance(scene_, *phase_, X_WM);
    if (!warm_) start();
    NearestInstance nearest;
    for (std::size_t i = 0; i < trackers_.size(); ++i) {
      const NearestPair pair = trackers_[i].nearest(X_WM);
      if (pair.triangle_moving >= 0 && pair.distance < nearest.distance)
        nearest = {static_cast<std::int32_t>(i), pair.distance, pair.triangle_moving, pair.triangle_fixed};
    }
    return nearest;
  }

 private:
  void start() {
    trackers_.clear();
    for (const auto& fixed : scene_.fixed)
      trackers_.emplace_back(scene_.moving->surface(), scene_.moving->prepared<Hierarchy>(), fixed->surface(),
                             fixed->prepared<Hierarchy>());
  }

  const Scene& scene_;
  bool warm_;
  std::optional<BroadPhase> phase_;  ///< Of a world.
  std::vector<NearestTracker> trackers_;
};

/// FCL's nearest two objects of several movers, nearest spheres first.
class MoverFclMinimum {
 public:
  explicit MoverFclMinimum(const MoverPlay& play) : play_(play), scene_(play.scene(0.0)), near_(scene_) {}

  FclResult at(std::size_t frame) {
    FclResult best;
    const std::vector<Pose>& poses = play_.poses[frame];
    for (const auto& [at_least, objects] : near_.within(std::numeric_limits<double>::infinity(), poses)) {
      if (best.fixed_body >= 0 && at_least > best.distance) break;
      const Pose X_FM = relative_pose(scene_.pose(objects.other, poses), poses[objects.mover]);
      const FclResult found = check_of(objects).distance(X_FM);
      if (best.fixed_body >= 0 && !(found.distance < best.distance)) continue;
      best = found;
      best.fixed_body = objects.number(scene_.object_count());
    }
    return best;
  }

 private:
  const FclCrosscheck& check_of(const ObjectPair& pair) {
    const std::pair key(scene_.movers[pair.mover].get(), scene_.body(pair.other).get());
    const auto found = checks_.find(key);
    if (found != checks_.end()) return found->second;
    return checks_.try_emplace(key, key.first->surface(), std::vector<const Surface*>{&key.second->surface()})
        .first->second;
  }

  const MoverPlay& play_;
  const MoverScene scene_;
  NearPairs near_;
  std::map<std::pair<const Body*, const Body*>, FclCrosscheck> checks_;
};

}  // namespace lmdbench
