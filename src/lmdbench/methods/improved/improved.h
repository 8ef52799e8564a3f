// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/worker_team.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/methods/improved/crowd_memo.h>
#include <lmdbench/methods/improved/options.h>
#include <lmdbench/methods/improved/plain_cache.h>
#include <lmdbench/methods/improved/result_cache.h>
#include <lmdbench/snch/traversal.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace lmdbench {

const MethodDescription& improved_method();
/// Of instances without `second_tracking`.
const MethodDescription& improved_method_tracking_once();

/// The improved algorithm (paper, section 4).
/// Global search: G1, G2, G3.a/b on the nodes; at leaves the visibility pre-test, then the exact
/// triangle distance without verification (4.1). It gives candidates: a vertex pair is found from
/// every pair of triangles round it. Local tracking: L1..L4 with exact distances and a result cache
/// for one update, with a second use: a candidate whose minimum was calculated for another one is
/// dropped (4.2, 4.2.1). The global thread tracks twice after a search: first reduction and second
/// tracking (4.3, decision E11).
///
/// Decision E7, ours: candidates come nearest first (`TrackingOrder`), so the published rule drops
/// the same in any visiting order. It also drops an LMD whose minimum a neighbour's walk saw and
/// left; `Reduction::LOSS_FREE` drops only what ends on the same feature pair.
class Improved : public Method {
 public:
  /// What it counts.
  enum class Counter : std::uint8_t {
    NODE_PAIRS,
    REJECTED_G1,
    REJECTED_G2,
    REJECTED_G3,
    LEAF_PAIRS,
    REJECTED_VISIBILITY,
    REJECTED_CUTOFF,
    TRIANGLE_DISTANCES,
    CACHE_HITS,
    TRACKING_STEPS,
    DROPPED_DUPLICATES
  };

  /// @param of_pair `Scene::is_pair`
  explicit Improved(Scene of_pair, const ImprovedOptions& options = {});

  const MethodDescription& description() const override {
    return options_.second_tracking ? improved_method() : improved_method_tracking_once();
  }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;

 private:
  /// The search's share of one triangle pair.
  void visit_leaves(const RigidTransform& X_WM, std::int32_t t_moving, std::int32_t t_fixed, LmdSet& lmds,
                    WorkCounters& counters) const;
  template <DirectionTest TEST>
  void search_alone(const RigidTransform& X_WM, LmdSet& lmds, WorkCounters& counters);
  template <DirectionTest TEST>
  void search_in_team(const RigidTransform& X_WM, LmdSet& lmds, WorkCounters& counters);
  template <class Cache>
  void track_with(Cache& cache, const Pose& X_WM, LmdSet& lmds, WorkCounters& counters);

  Scene scene_;
  ImprovedOptions options_;
  const Surface &moving_, &fixed_;
  const Hierarchy &hierarchy_moving_, &hierarchy_fixed_;
  DualTraversal traversal_;
  // With several threads: who they are, where each place's search goes on, and what it found.
  std::unique_ptr<WorkerTeam> team_;
  std::vector<DualTraversal> traversals_;
  std::vector<DualTraversal::Place> places_;
  std::vector<LmdSet> found_;
  ResultCache cache_;
  PlainCache plain_cache_;  ///< In use instead where the option says so.
  CrowdMemo crowds_;
  LmdSet kept_;
};

}  // namespace lmdbench
