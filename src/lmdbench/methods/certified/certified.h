// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/plateau.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/methods/certified/coherence/coherence_policy.h>
#include <lmdbench/methods/certified/coherence/traversal_front.h>
#include <lmdbench/methods/certified/filter.h>
#include <lmdbench/methods/certified/hierarchy/wide_traversal.h>
#include <lmdbench/methods/certified/options.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace lmdbench {

const MethodDescription& certified_method();

/// The third algorithm: the exact and complete LMD set in every
/// frame, without a second rate.
///
/// 1. Both meshes have a wide hierarchy over their features with non-empty outward polar cone
///    (wide_hierarchy.h). Descending both finds every feature pair that bounds cannot reject
///    (wide_traversal.h).
/// 2. A closed-form test in double precision rejects nearly all of those (filter.h).
/// 3. What is left is decided by the predicates that define the ground truth: exact triangle distance,
///    first-order test, plateau merging (first_order.h, plateau.h).
///
/// Why the set equals `exhaustive`'s: PROOF.md, bound by bound. In short, what is reported has passed the
/// truth's own test; and no bound on the way to it rejects a pair that the truth accepts, because pairs nearer
/// than the touch distance are held back by no cone, and farther ones have accurate directions.
///
/// Frame coherence: where the pose moves by little, step 1 is not made anew. Every test of the last
/// frames is kept with the number of frames that it stands if the motion goes on as forecast
/// (wide_lifetime.h), and so are the answers of step 2 (PairFilter). What a frame does again is what has
/// run out, and whatever the motion, as it turns out, has deviated too far for (motion_forecast.h); what
/// may be an LMD is decided in every frame. Where the pose jumps, and where next to nothing stands
/// (coherence_policy.h), the frame is searched from scratch and nothing is kept. The set is the same
/// either way; the work counters tell what was done.
class Certified : public Method {
 public:
  /// What it counts.
  enum class Counter : std::uint8_t {
    NODE_PAIRS,
    REJECTED_G1,
    REJECTED_G2,
    REJECTED_G3,
    LEAF_PAIRS,
    REJECTED_CUTOFF,
    TRIANGLE_DISTANCES,
    FIRST_ORDER_TESTS
  };

  /// @param kernel form of the node test where the frame is searched from scratch
  explicit Certified(Scene scene, const CertifiedOptions& options = {},
                     WideKernel kernel = WideKernel::VECTOR);

  const MethodDescription& description() const override { return certified_method(); }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    search(X_WM, lmds, counters);
  }

 private:
  struct TrianglePair {
    std::int32_t moving, fixed;
    auto operator<=>(const TrianglePair&) const = default;
  };

  Certificate decide(const PairFilter& filter, std::int32_t body, const WidePair& candidate, double lever_arm,
                     WorkCounters& counters);
  Certificate decide_touching(const PairFilter& filter, std::int32_t body, const WidePair& candidate,
                              double lever_arm, WorkCounters& counters);
  void decide_pending(const PairFilter& filter, std::int32_t body, WorkCounters& counters);
  bool evaluate(const PairFilter& filter, std::int32_t body, const TrianglePair& pair, LocalMinimum& minimum,
                WorkCounters& counters) const;
  void report(double coordinates, LmdSet& lmds);

  Scene scene_;
  const WideHierarchy& hierarchy_moving_;
  std::vector<const WideHierarchy*> hierarchies_fixed_;  ///< One a fixed body.
  bool coherent_;
  WideKernel kernel_;
  double touch_ = 0.0;
  WideScratch scratch_;
  std::vector<TrianglePair> pending_;
  std::vector<LocalMinimum> minima_;

  /// Of one fixed body; empty where nothing is kept.
  struct Kept {
    TraversalFront front;
    CoherencePolicy policy;
  };
  std::vector<Kept> kept_;
  MotionForecast motion_;
  bool has_last_ = false;  ///< The forecast knows the last frame.
};

}  // namespace lmdbench
