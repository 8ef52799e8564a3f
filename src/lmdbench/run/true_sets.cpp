// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/force/aggregate.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/run/true_sets.h>

#include <algorithm>
#include <memory>

namespace lmdbench {

TrueSets true_sets(const PreparedRun& run, std::int64_t checks, const Progress& progress) {
  const std::unique_ptr<Method> certified = make_method("certified", run.scene());
  const std::unique_ptr<Method> exhaustive = make_method("exhaustive", run.scene());
  const auto frames = static_cast<std::int64_t>(run.input.poses.size());
  TrueSets truth;
  WorkCounters ignored;
  LmdSet other;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const Pose& X_WM = run.input.poses[static_cast<std::size_t>(frame)];
    LmdSet& set = truth.sets.emplace_back();
    certified->search(X_WM, set, ignored);
    // The frames at which an even spread of `checks` over `frames` steps on; the first one is among them.
    if (frame * checks / frames != (frame - 1) * checks / frames || (frame == 0 && checks > 0)) {
      other.clear();
      exhaustive->search(X_WM, other, ignored);
      ++truth.checked_frames;
      if (!agreement(other, set, Match::SAME_FEATURES, run.scene()).exact()) ++truth.wrong_frames;
    }
    if (progress && !progress(frame + 1, frames)) throw Interrupted();
  }
  return truth;
}

std::vector<TruthFrame> truth_frames(const TrueSets& truth, const PreparedRun& run, std::int64_t first) {
  const auto rendered = [&](std::size_t frame, ForceLaw law) {
    ForceProfile profile = run.profiles.front().force;
    profile.law = law;
    const Vec3 reference_W = RigidTransform(run.input.poses[frame]).point(run.input.reference_M);
    return run.input.device.render(sum_forces(truth.sets[frame], profile, reference_W), profile.largest_sum)
        .force;
  };
  std::vector<TruthFrame> result;
  for (auto frame = static_cast<std::size_t>(first); frame + 1 < truth.sets.size(); ++frame) {
    TruthFrame here;
    here.frame = static_cast<std::int64_t>(frame);
    here.lmds = truth.sets[frame];
    for (const ForceLaw law : {ForceLaw::LINEAR, ForceLaw::EXPONENTIAL}) {
      const auto index = static_cast<std::size_t>(law);
      here.force[index] = rendered(frame, law);
      here.force_jump[index] = (rendered(frame + 1, law) - here.force[index]).norm();
    }
    result.push_back(std::move(here));
  }
  return result;
}

}  // namespace lmdbench
