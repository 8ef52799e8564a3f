// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/method_options.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/methods/improved/result_cache.h>
#include <lmdbench/snch/traversal.h>

#include <cstdint>
#include <utility>

namespace lmdbench {

/// The improved algorithm (paper, section 4).
///   Global search: G1, G2, G3.a/b on the nodes; at the leaves the visibility pre-test, then the exact
///   triangle distance without further verification (4.1). The result are candidates: a vertex pair is found
///   from every pair of triangles round it. Local tracking: L1..L4 with exact distances, a result cache that
///   lives for one update, and its second use: a candidate whose minimum was already calculated for another
///   one is dropped (4.2, 4.2.1). In the global thread tracking runs twice after a search: first reduction
///   and second tracking (4.3, decision E11).
///
/// Decision E7, ours: candidates are processed nearest first (`TrackingOrder`), so that what the published
/// rule drops does not depend on visiting order. That rule also drops an LMD whose minimum a neighbour's walk
/// happened to look at and left; `Reduction::LOSS_FREE` drops only what ends on the same feature pair.
class Improved : public Method {
 public:
  Improved(Scene scene, const MethodOptions& options) : scene_(std::move(scene)), options_(options) {}

  std::string_view name() const override { return "improved"; }
  bool tracks_locally() const override { return true; }
  int trackings_after_search() const override { return 2; }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;

 private:
  void search_body(const RigidTransform& X_WM, std::int32_t fixed_body, LmdSet& lmds, WorkCounters& counters);

  Scene scene_;
  MethodOptions options_;
  DualTraversal traversal_;
  ResultCache cache_;
  LmdSet kept_;
};

}  // namespace lmdbench
