// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/crosscheck/fcl_crosscheck.h>
#include <lmdbench/experiment/rules.h>
#include <lmdbench/run/fcl_probe.h>
#include <lmdbench/run/mover_probe.h>
#include <lmdbench/snch/nearest_tracker.h>
#include <lmdbench/world/nearest_instance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

namespace lmdbench {
namespace {

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

/// Exact minimum distance to any of the fixed meshes, frame after frame.
class ExactMinimum {
 public:
  /// @param warm  whether a search begins with the last one's triangles
  ExactMinimum(const Scene& scene, bool warm) : scene_(scene), warm_(warm) {
    if (scene.is_world())
      phase_.emplace(scene);
    else
      start();
  }

  double at(const Pose& X_WM) {
    if (phase_) return nearest_instance(scene_, *phase_, X_WM).distance;
    if (!warm_) start();
    double least = std::numeric_limits<double>::infinity();
    for (NearestTracker& tracker : trackers_) {
      const NearestPair pair = tracker.nearest(X_WM);
      if (pair.triangle_moving >= 0) least = std::min(least, pair.distance);
    }
    return least;
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

/// What is known of a frame.
struct FclAnswers {
  std::int64_t frame;
  const Pose& X_WM;
  const FclResult& theirs;
  double exact;  ///< [m]
  double cutoff, tolerance_relative;
};

/// Compares FCL's distance with the exact one and with that of each method.
/// @param search finds the set of a method
template <typename Search>
void add_fcl_frame(FclCheck& check, const FclAnswers& of, const std::vector<LockstepMethod>& methods,
                   Search&& search) {
  const FclResult& theirs = of.theirs;
  FclFrame row;
  row.frame = of.frame;
  row.distance = theirs.distance;
  row.separated = theirs.separated;
  row.triangle_moving = theirs.triangle_moving;
  row.triangle_fixed = theirs.triangle_fixed;
  row.fixed_body = theirs.fixed_body;
  row.lmdbench_distance = of.exact;
  const bool we_separate = row.lmdbench_distance > 0.0;
  if (theirs.separated && we_separate)
    row.relative_difference = std::abs(theirs.distance - row.lmdbench_distance) / row.lmdbench_distance;
  row.agrees = theirs.separated == we_separate &&
               (!theirs.separated || row.relative_difference <= of.tolerance_relative);
  const auto note = [&](const std::string& who, double distance) {
    check.exceptions.push_back({of.frame, who, of.X_WM, distance, row.distance, row.lmdbench_distance,
                                row.triangle_moving, row.triangle_fixed, row.fixed_body});
  };
  if (!row.agrees) note("lmdbench", row.lmdbench_distance);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    double difference = UNSET;
    if (theirs.separated && theirs.distance * (1.0 + of.tolerance_relative) < of.cutoff) {
      const double ours = minimum_distance(search(i));
      difference = std::isnan(ours) ? std::numeric_limits<double>::infinity()
                                    : (ours - theirs.distance) / theirs.distance;
      if (!(std::abs(difference) <= of.tolerance_relative)) note(methods[i].label, ours);
    }
    row.method_difference.push_back(difference);
  }
  check.frames.push_back(std::move(row));
}

/// Not in the order in which the experiment lists its methods: the result must not depend on it.
void sort_exceptions(FclCheck& check) {
  std::sort(check.exceptions.begin(), check.exceptions.end(),
            [](const FclException& a, const FclException& b) {
              return std::tie(a.frame, a.who) < std::tie(b.frame, b.who);
            });
}

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

}  // namespace

FclCheck probe_fcl(const Scene& scene, const LockstepInput& input, const std::vector<LockstepMethod>& methods,
                   const std::vector<std::int64_t>& frames, double tolerance_relative,
                   const Progress& progress, const ProbeShortcuts& shortcuts) {
  DeformingScene bodies(scene, input.deformation);
  std::vector<std::unique_ptr<Method>> instances;
  for (const LockstepMethod& method : methods) instances.push_back(method.make_for(bodies));

  // Where meshes deform FCL's models are built anew in each frame: its refit from the leaves up gives wrong distances for RSS and
  // OBBRSS, since RSS::operator+ takes one axis of the sum from an operand, so that its frame is not orthonormal (FCL 0.7.0).
  std::optional<FclMinimum> fcl;
  ExactMinimum exact(bodies.scene(), shortcuts.warm && !bodies.deforms());
  FclCheck check;
  WorkCounters ignored;
  LmdSet lmds;
  std::size_t noted = 0;  // exceptions before those of the last frame
  for (const std::int64_t frame : frames) {
    const Pose& X_WM = input.poses[static_cast<std::size_t>(frame)];
    if (shortcuts.reuse_repeated && !bodies.deforms() && !check.frames.empty() &&
        same_pose(input.poses[static_cast<std::size_t>(check.frames.back().frame)], X_WM)) {
      check.frames.push_back(check.frames.back());
      check.frames.back().frame = frame;
      const std::vector<FclException> again(check.exceptions.begin() + static_cast<std::ptrdiff_t>(noted),
                                            check.exceptions.end());
      noted = check.exceptions.size();
      for (FclException exception : again) {
        exception.frame = frame;
        check.exceptions.push_back(std::move(exception));
      }
      tell_progress(progress, check.frames.size(), frames.size());
      continue;
    }
    noted = check.exceptions.size();
    bodies.to_frame(frame);
    if (!fcl || bodies.deforms()) fcl.emplace(bodies.scene());
    const FclResult theirs = fcl->at(X_WM);
    add_fcl_frame(check, {frame, X_WM, theirs, exact.at(X_WM), scene.cutoff, tolerance_relative}, methods,
                  [&](std::size_t i) -> const LmdSet& {
                    lmds.clear();
                    instances[i]->search(X_WM, lmds, ignored);
                    return lmds;
                  });
    tell_progress(progress, check.frames.size(), frames.size());
  }
  sort_exceptions(check);
  return check;
}

FclCheck probe_mover_fcl(const MoverPlay& play, double cutoff, const std::vector<LockstepMethod>& methods,
                         const std::vector<std::int64_t>& frames, double tolerance_relative,
                         const Progress& progress) {
  const auto poses = std::make_shared<std::vector<Pose>>();
  std::vector<std::unique_ptr<Method>> instances;
  for (const LockstepMethod& method : methods)
    instances.push_back(method.make_among(play.scene(cutoff), poses));
  MoverFclMinimum fcl(play);
  MoverDistances exact(play);
  FclCheck check;
  WorkCounters ignored;
  LmdSet lmds;
  for (const std::int64_t frame : frames) {
    const auto at = static_cast<std::size_t>(frame);
    *poses = play.poses[at];
    const FclResult theirs = fcl.at(at);
    const Pose& X_WM = (*poses)[ObjectPair::of(theirs.fixed_body, play.object_count()).mover];
    add_fcl_frame(check, {frame, X_WM, theirs, exact.at(at).distance, cutoff, tolerance_relative}, methods,
                  [&](std::size_t i) -> const LmdSet& {
                    lmds.clear();
                    instances[i]->search(X_WM, lmds, ignored);
                    return lmds;
                  });
    tell_progress(progress, check.frames.size(), frames.size());
  }
  sort_exceptions(check);
  return check;
}

}  // namespace lmdbench
