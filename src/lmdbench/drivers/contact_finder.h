// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/aggregation.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/near_frame.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace lmdbench {

/// Constants of `layered`.
struct LayeredChoice {
  double patch_cutoff = PATCH_CUTOFF;  ///< SurfaceSampler's.
  /// A minimum's area over cutoff * the diagonal of the pair's smaller mesh: minima only direct
  /// components without a patch (`lmdbench-study continuous-force --part bores --minimum-area`).
  double minimum_area_share = 0.025;
};

/// Finds what an aggregation needs of a pose and combines it into force and torque.
///
/// A force is of a pair of objects: merges and patches of surface are found pair by pair, with
/// instances or several movers in the second one's frame, and near the meshes (NearFrame), as
/// methods search. An object feels the sum of its pairs.
class ContactFinder {
 public:
  /// @param scene  the searching method's; read if the aggregation needs more than critical pairs
  ContactFinder(const Aggregation& aggregation, Scene scene, const LayeredChoice& layered = {});

  const Aggregation& aggregation() const { return aggregation_; }

  /// Finds the LMD set, as Method::search does, and all else that the aggregation needs.
  /// @pre the method finds critical pairs, unless the aggregation needs minima alone
  void search(Method& method, const Pose& X_WM, LmdSet& lmds, WorkCounters& counters);

  /// Wrench on `Scene::moving`.
  /// @param lmds  Sorted by `lmd_less`: the last search's, up to the profile's cutoff, some with
  /// remembered directions (E12). `sum` takes any set.
  /// @param method  that made the last search. A force of its own replaces the aggregation; its
  /// stiffness, a slope with the pose, is NaN.
  Wrench combine(const LmdSet& lmds, const ForceProfile& profile, const Vec3& reference_W,
                 const Method* method = nullptr);

  /// Splits the set of several movers, for `set_of` and `wrench_on`.
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

  /// LMDs of the last search up to `cutoff` without an index (CriticalPair::has_index): the force
  /// may jump at their birth or death. 0 if the aggregation needs minima alone.
  std::int64_t without_index(double cutoff) const;

 private:
  /// What a mover feels.
  struct Part {
    LmdSet lmds;
    CriticalSet critical;
    std::vector<Merge> merges;
    std::vector<SurfaceSample> samples;
    std::vector<double> minimum_areas;  ///< As ForceInput's.
  };

  bool is_sum() const { return aggregation_.name == sum_law().name; }
  void take(const LmdSet& lmds);
  void find_merges(const Pose& X_WM);
  const NearFrame& near_frame_of(const ObjectPair& pair);

  const Aggregation& aggregation_;
  Scene scene_;
  LayeredChoice layered_;
  struct Near {
    NearFrame frame;
    std::uint64_t deformations;
  };
  /// Of two meshes in the frame in which methods search them.
  std::map<std::pair<const Body*, const Body*>, Near> near_;
  CriticalSet critical_;
  std::vector<Merge> merges_;
  std::vector<SurfaceSample> samples_;
  std::vector<double> minimum_areas_;
  std::vector<Part> parts_;  ///< One a mover, where several move.
};

}  // namespace lmdbench
