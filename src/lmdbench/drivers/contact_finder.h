// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/aggregation.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// Constants of `layered`.
struct LayeredChoice {
  double patch_cutoff = PATCH_CUTOFF;  ///< SurfaceSampler's.
  /// ForceInput::minimum_area over the product of the cutoff and the smallest mesh's diagonal: so small that minima only lend a
  /// direction to what has no patch yet. `lmdbench-study continuous-force --part bores --minimum-area` sweeps it.
  double minimum_area_share = 0.025;
};

/// Finds of a pose what an aggregation needs to know, and combines it into force and torque.
///
/// A force is of a pair of objects: what saddles join, and patches of surface, are looked for pair by pair, in the frame of the second where
/// the scene has instances or several movers. An object feels the sum over its pairs.
class ContactFinder {
 public:
  /// @param scene  that of the method which will search; read where the aggregation needs more than critical pairs
  ContactFinder(const Aggregation& aggregation, Scene scene, const LayeredChoice& layered = {});

  const Aggregation& aggregation() const { return aggregation_; }

  /// Finds the LMD set, as Method::search does, and what else the aggregation needs.
  /// @pre the method finds critical pairs, unless the aggregation needs minima alone
  void search(Method& method, const Pose& X_WM, LmdSet& lmds, WorkCounters& counters);

  /// Of `Scene::moving`.
  /// @param lmds  Sorted by `lmd_less`: of the last search, less those beyond the profile's cutoff, with directions that may have
  ///              been remembered (E12). `sum` takes any set.
  /// @param method  that made the last search: where it has a force of its own, that takes the aggregation's place. How such a force
  ///                changes with the pose is not known: its stiffness is NaN.
  Wrench combine(const LmdSet& lmds, const ForceProfile& profile, const Vec3& reference_W,
                 const Method* method = nullptr);

  /// Several meshes that move: the set of each, for `set_of` and `wrench_on`.
  /// @param lmds  as of `combine`
  void split(const LmdSet& lmds);
  /// LMDs of a mover's pairs, turned round where it is the second of the pair.
  const LmdSet& set_of(std::size_t mover) const { return parts_[mover].lmds; }
  /// What a mover feels of the set that was split.
  /// @param method  as of `combine`
  Wrench wrench_on(std::size_t mover, const ForceProfile& profile, const Vec3& reference_W,
                   const Method* method = nullptr) const;

  /// Search and combination in one.
  Wrench wrench_at(Method& method, const Pose& X_WM, const ForceProfile& profile, const Vec3& reference_W);

  /// LMDs of the last search up to `cutoff` that have no index (CriticalPair::has_index): where they are born or die the force may
  /// jump. 0 for an aggregation that needs minima alone.
  std::int64_t without_index(double cutoff) const;

 private:
  /// What a mover feels.
  struct Part {
    LmdSet lmds;
    CriticalSet critical;
    std::vector<Merge> merges;
    std::vector<SurfaceSample> samples;
  };

  bool is_sum() const { return aggregation_.name == sum_law().name; }
  void take(const LmdSet& lmds);
  void find_pair_by_pair(const Pose& X_WM);

  const Aggregation& aggregation_;
  Scene scene_;
  double patch_cutoff_, minimum_area_;
  MergeFinder merge_finder_;
  SurfaceSampler sampler_;
  CriticalSet critical_;
  std::vector<Merge> merges_;
  std::vector<SurfaceSample> samples_;
  std::vector<Part> parts_;  ///< One a mover, where several move.
};

}  // namespace lmdbench
