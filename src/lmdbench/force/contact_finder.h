// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/aggregation.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>

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
class ContactFinder {
 public:
  /// @param scene  that of the method which will search; read where the aggregation needs more than critical pairs
  ContactFinder(const Aggregation& aggregation, Scene scene, const LayeredChoice& layered = {});

  const Aggregation& aggregation() const { return aggregation_; }

  /// Finds the LMD set, as Method::search does, and what else the aggregation needs.
  /// @pre the method finds critical pairs, unless the aggregation needs minima alone
  void search(Method& method, const Pose& X_WM, LmdSet& lmds, WorkCounters& counters);

  /// @param lmds  Sorted by `lmd_less`: of the last search, less those beyond the profile's cutoff, with directions that may have
  ///              been remembered (E12). `sum` takes any set.
  Wrench combine(const LmdSet& lmds, const ForceProfile& profile, const Vec3& reference_W);

  /// Search and combination in one.
  Wrench wrench_at(Method& method, const Pose& X_WM, const ForceProfile& profile, const Vec3& reference_W);

  /// LMDs of the last search up to `cutoff` that have no index (CriticalPair::has_index): where they are born or die the force may
  /// jump. 0 for an aggregation that needs minima alone.
  std::int64_t without_index(double cutoff) const;

 private:
  const Aggregation& aggregation_;
  double minimum_area_;
  MergeFinder merge_finder_;
  SurfaceSampler sampler_;
  CriticalSet critical_;
  std::vector<Merge> merges_;
  std::vector<SurfaceSample> samples_;
};

}  // namespace lmdbench
