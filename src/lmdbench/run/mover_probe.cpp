// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>
#include <lmdbench/run/mover_probe.h>
#include <lmdbench/snch/minimum_distance.h>
#include <lmdbench/world/mesh_bounds.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace lmdbench {
namespace {

/// LMDs by their pair's number, named as of a scene of the two alone.
std::map<std::int32_t, LmdSet> by_pair(const LmdSet& lmds) {
  std::map<std::int32_t, LmdSet> sets;
  for (Lmd lmd : lmds) {
    const std::int32_t number = std::exchange(lmd.fixed_body, 0);
    sets[number].push_back(lmd);
  }
  return sets;
}

Agreement agreement_of_pairs(const LmdSet& truth, const LmdSet& reported, Match match,
                             const MoverScene& scene) {
  Agreement sum;
  auto true_sets = by_pair(truth), reported_sets = by_pair(reported);
  for (const auto& [number, set] : reported_sets) true_sets.try_emplace(number);
  for (const auto& [number, set] : true_sets) {
    const ObjectPair pair = ObjectPair::of(number, scene.object_count());
    sum += agreement(set, reported_sets[number], match,
                     {scene.movers[pair.mover], {scene.body(pair.other)}, scene.cutoff});
  }
  return sum;
}

}  // namespace

MoverDistances::Nearest MoverDistances::at(std::size_t frame, double bound) {
  Nearest nearest;
  const std::vector<Pose>& poses = play_.poses[frame];
  double least = bound;
  for (const auto& [at_least, objects] : near_.within(bound, poses)) {
    if (at_least > least) break;
    const Body &mover = *scene_.movers[objects.mover], &other = *scene_.body(objects.other);
    const NearestPair pair = nearest_pair(
        mover.surface(), mover.prepared<Hierarchy>(), other.surface(), other.prepared<Hierarchy>(),
        relative_pose(scene_.pose(objects.other, poses), poses[objects.mover]), least);
    if (pair.triangle_moving < 0 || !(pair.distance < nearest.distance)) continue;
    nearest = {pair.distance, objects, pair.triangle_moving, pair.triangle_fixed};
    least = pair.distance;
  }
  return nearest;
}

bool MoverDistances::any_within(std::size_t frame, double distance) {
  const std::vector<Pose>& poses = play_.poses[frame];
  return std::ranges::any_of(near_.within(distance, poses), [&](const NearPairs::Pair& pair) {
    const auto& objects = pair.objects;
    const Body &mover = *scene_.movers[objects.mover], &other = *scene_.body(objects.other);
    return within_distance(mover.surface(), mover.prepared<Hierarchy>(), other.surface(),
                           other.prepared<Hierarchy>(),
                           relative_pose(scene_.pose(objects.other, poses), poses[objects.mover]), distance);
  });
}

std::vector<bool> frames_in_contact(const MoverPlay& play, double cutoff) {
  MoverDistances distances(play);
  std::vector<bool> in_contact;
  for (std::size_t frame = 0; frame < play.poses.size(); ++frame)
    in_contact.push_back(distances.any_within(frame, cutoff));
  return in_contact;
}

std::vector<TruthFrame> probe_mover_truth(const MoverPlay& play, const LockstepInput& input,
                                          const ForceProfile& profile,
                                          const std::vector<std::int64_t>& frames, const Progress& progress,
                                          const std::vector<bool>* in_contact) {
  const auto poses = std::make_shared<std::vector<Pose>>();
  const std::unique_ptr<Method> exhaustive = make_among_movers(
      play.scene(profile.cutoff), poses, method_description("exhaustive"), method_maker("exhaustive"));
  WorkCounters ignored;
  std::vector<LmdSet> sets;
  const auto search = [&](std::int64_t frame) {
    TruthFrame found;
    const auto at = static_cast<std::size_t>(frame);
    *poses = play.poses[at];
    if (in_contact == nullptr || (*in_contact)[at]) exhaustive->search(Pose{}, found.lmds, ignored);
    split_by_mover(found.lmds, play, sets);
    for (const ForceLaw law : force_laws()) {
      ForceProfile with_law = profile;
      with_law.law = law;
      std::vector<Vec3>& forces = found.movers[static_cast<std::size_t>(law)];
      for (const MoverFrame& mover : render_movers(sets, play, *poses, with_law, input.device))
        forces.push_back(mover.force);
      found.force[static_cast<std::size_t>(law)] = forces.front();
    }
    return found;
  };
  return truth_of_frames(frames, search, progress);
}

std::vector<TruthComparison> compare_with_truth(const std::vector<TruthFrame>& truth,
                                                const MethodRecord& record, ForceLaw law,
                                                const MoverPlay& play) {
  const MoverScene scene = play.scene(0.0);
  std::vector<TruthComparison> comparisons;
  for (const TruthFrame& here : truth) {
    const LmdSet& lmds = record.lmds.at(here.frame);
    const auto frame = static_cast<std::size_t>(here.frame);
    const std::vector<Vec3>& forces = here.movers[static_cast<std::size_t>(law)];
    TruthComparison comparison;
    comparison.same = agreement_of_pairs(here.lmds, lmds, Match::SAME_FEATURES, scene);
    comparison.neighbours = agreement_of_pairs(here.lmds, lmds, Match::NEIGHBOURING_FEATURES, scene);
    comparison.minimum_distance_error = minimum_distance(lmds) - minimum_distance(here.lmds);
    comparison.force_error = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const Vec3& force = record.movers[frame * forces.size() + i].force;
      comparison.force_error = std::max(comparison.force_error, (force - forces[i]).norm());
      const double angle = force_angle(force, forces[i]);
      if (!(angle <= comparison.force_angle_error) && !std::isnan(angle))
        comparison.force_angle_error = angle;
    }
    comparison.force_jump = (record.frames[frame + 1].force - record.frames[frame].force).norm();
    comparisons.push_back(comparison);
  }
  return comparisons;
}

}  // namespace lmdbench
