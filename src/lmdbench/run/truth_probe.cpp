// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/rules.h>
#include <lmdbench/force/contact_finder.h>
#include <lmdbench/geometry/cone.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/run/truth_probe.h>

#include <cstddef>
#include <optional>
#include <utility>

namespace lmdbench {

double force_angle(const Vec3& a, const Vec3& b) {
  return a.isZero(0.0) || b.isZero(0.0) ? UNSET : angle_between(a, b);
}

std::vector<TruthFrame> truth_of_frames(const std::vector<std::int64_t>& frames,
                                        const std::function<TruthFrame(std::int64_t frame)>& truth_at,
                                        const Progress& progress) {
  std::vector<TruthFrame> truth;
  for (const std::int64_t frame : frames) {
    TruthFrame here = truth_at(frame);
    here.frame = frame;
    const TruthFrame next = truth_at(frame + 1);
    for (std::size_t law = 0; law < FORCE_LAW_COUNT; ++law)
      here.force_jump[law] = (next.force[law] - here.force[law]).norm();
    truth.push_back(std::move(here));
    tell_progress(progress, truth.size(), frames.size());
  }
  return truth;
}

std::vector<TruthFrame> probe_truth(const Scene& scene, const LockstepInput& input,
                                    const ForceProfile& profile, const Aggregation& aggregation,
                                    const std::vector<std::int64_t>& frames, const Progress& progress,
                                    const std::vector<bool>* in_contact, bool reuse_repeated) {
  DeformingScene bodies(scene, input.deformation);
  reuse_repeated = reuse_repeated && !bodies.deforms();
  const std::unique_ptr<Method> exhaustive = make_method("exhaustive", bodies.scene());
  ContactFinder contacts(aggregation, bodies.scene());
  WorkCounters ignored;
  std::optional<Pose> searched;  // where the last set was found, ...
  TruthFrame last;               // ... and what was found
  const auto search = [&](std::int64_t frame) -> TruthFrame {
    const auto at = static_cast<std::size_t>(frame);
    if (in_contact != nullptr && !(*in_contact)[at]) return {};
    const Pose& X_WM = input.poses[at];
    if (reuse_repeated && searched && same_pose(*searched, X_WM)) return last;
    bodies.to_frame(frame);
    TruthFrame found;
    contacts.search(*exhaustive, X_WM, found.lmds, ignored);
    const Vec3 reference_W = RigidTransform(X_WM).point(input.reference_M);
    for (const ForceLaw law : force_laws()) {
      ForceProfile with_law = profile;
      with_law.law = law;
      found.force[static_cast<std::size_t>(law)] =
          input.device.render(contacts.combine(found.lmds, with_law, reference_W), profile.largest_sum).force;
    }
    if (reuse_repeated) {
      searched = X_WM;
      last = found;
    }
    return found;
  };
  return truth_of_frames(frames, search, progress);
}

std::vector<TruthComparison> compare_with_truth(const std::vector<TruthFrame>& truth,
                                                const MethodRecord& record, ForceLaw law,
                                                const Scene& scene) {
  std::vector<TruthComparison> comparisons;
  for (const TruthFrame& here : truth) {
    const LmdSet& lmds = record.lmds.at(here.frame);
    const FrameRecord& frame = record.frames[static_cast<std::size_t>(here.frame)];
    const FrameRecord& next = record.frames[static_cast<std::size_t>(here.frame) + 1];
    const Vec3& true_force = here.force[static_cast<std::size_t>(law)];
    TruthComparison comparison;
    comparison.same = agreement(here.lmds, lmds, Match::SAME_FEATURES, scene);
    comparison.neighbours = agreement(here.lmds, lmds, Match::NEIGHBOURING_FEATURES, scene);
    comparison.minimum_distance_error = minimum_distance(lmds) - minimum_distance(here.lmds);
    comparison.force_error = (frame.force - true_force).norm();
    comparison.force_angle_error = force_angle(frame.force, true_force);
    comparison.force_jump = (next.force - frame.force).norm();
    comparisons.push_back(comparison);
  }
  return comparisons;
}

}  // namespace lmdbench
