// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>
#include <lmdbench/decision/intersection_polylines.h>
#include <lmdbench/decision/intersections.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/methods/certified/decide/touching_pairs.h>
#include <lmdbench/methods/certified/keep/coherence_policy.h>
#include <lmdbench/methods/certified/keep/traversal_front.h>
#include <lmdbench/methods/certified/options.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace lmdbench {

class SignedFeatures;

const MethodDescription& certified_method();

/// The third algorithm: the exact and complete LMD set in every frame, without a second rate. In the order in which one reads it:
/// `layout/` (what a hierarchy is), `build/` (how it is made and brought to a mesh that deforms), `traverse/` (how two are descended),
/// `decide/` (what happens to the pairs that are left), `keep/` (what stays from frame to frame), this file.
///
/// 1. *enumerate*: both meshes have a wide hierarchy over the features of their shapes (wide_hierarchy.h). Descending both
///    finds every pair of features that bounds cannot reject (wide_traversal.h); a closed-form test in double precision
///    rejects nearly all of those (filter.h).
/// 2. *decide*: the definition is asked for what is left (decision/decide.h), and for the corners of triangles that may touch
///    (touching_pairs.h), which also says what intersects;
/// 3. *join*: what the pairs say of one place becomes one LMD (decision/join_contacts.h).
///
/// `exhaustive` asks the same definition for every pair near enough and joins in the same way. So the two sets differ only
/// where a bound is wrong: PROOF.md, bound by bound.
///
/// Frame coherence: where the pose moves by little, step 1 is not made anew. Every test of the last frames is kept with the
/// number of frames that it stands if the motion goes on as forecast (wide_lifetime.h), and so are the answers of the filter.
/// What a frame does again is what has run out, and whatever the motion, as it turns out, has deviated too far for
/// (motion_forecast.h); steps 2 and 3 are made in every frame. Where the pose jumps, and where next to nothing is kept
/// (coherence_policy.h), the frame is searched from scratch. Where a mesh deforms, what was kept of the nodes that changed is made
/// again (TraversalFront::follow). The set is the same either way; the work counters tell what was done.
class Certified : public Method {
 public:
  /// What it counts.
  enum class Counter : std::uint8_t {
    NODE_PAIRS,
    REJECTED_G1,
    REJECTED_G2,
    REJECTED_G3,
    LEAF_PAIRS,
    DECISIONS,
    TRIANGLE_DISTANCES
  };

  /// @param of_pair `Scene::is_pair`
  /// @param kernel form of the node test where the frame is searched from scratch
  explicit Certified(Scene of_pair, const CertifiedOptions& options = {},
                     WideKernel kernel = WideKernel::VECTOR);

  const MethodDescription& description() const override { return certified_method(); }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    search(X_WM, lmds, counters);
  }
  /// The same three steps over hierarchies that own every feature with an index (hierarchy/signed_hierarchy.h); what is kept from
  /// frame to frame is kept apart from `search`.
  void find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) override;

  /// Calls visit(pair) for every pair of triangles that shared a point at the last pose; some more than once.
  template <class Visit>
  void for_each_intersecting_pair(Visit&& visit) const {
    for (const CrossingPair& pair : crossing_pairs_) visit(pair);
  }

 private:
  /// The fixed body, what is prepared for it and what is kept of the pair.
  struct FixedBody {
    const Surface& surface;
    const ShapeComplex& shape;
    const WideHierarchy& hierarchy;
    const SignedFeatures* signs;  ///< Where critical pairs are looked for.
    TraversalFront front;         ///< Empty where nothing is kept.
    CoherencePolicy policy;
    std::uint32_t seen_moving = 0, seen_fixed = 0;  ///< Deformations that the front knows.
    double search_distance = 0.0;                   ///< That its tests were made for [m].
  };
  struct Frame;

  /// @param with_critical  looks for critical pairs
  Certified(Scene of_pair, const CertifiedOptions& options, WideKernel kernel, bool with_critical);
  /// Steps 1 and 2; calls join(the two at the pose).
  template <class Join>
  void find(const Pose& X_WM, WorkCounters& counters, Join&& join);

  // Steps 1 and 2. No other name begins with `search`: instructions are counted by that name (scripts/tuned_constants.py).
  bool follow_motion(const RigidTransform& X_WM, double touch, double search_distance);
  void follow_deformations();
  void enumerate_from_scratch(Frame& frame);
  void enumerate_coherently(Frame& frame);

  Scene scene_;
  const WideHierarchy& hierarchy_moving_;
  const ShapeComplex& shape_moving_;
  const SignedFeatures* signs_moving_;  ///< Where critical pairs are looked for.
  CertifiedOptions options_;
  FixedBody fixed_;
  bool coherent_;
  VectorTarget target_;
  WideKernel kernel_;
  MotionForecast motion_;
  bool has_last_ = false;         ///< The forecast knows the last frame.
  double touch_ = 0.0;            ///< Of the last frame [m].
  std::uint32_t seen_frame_ = 0;  ///< Deformation of the moving hierarchy after which the forecast began.

  ContactSet contacts_;
  std::vector<Intersection> intersections_;
  std::vector<CrossingPair> crossing_pairs_;
  TouchingPairs touching_;
  std::vector<WidePair> touching_pairs_;
  std::vector<std::uint32_t> touching_leaves_;  ///< Of touching_pairs_, in the front.
  std::unique_ptr<Certified> critical_;         ///< Looks for critical pairs; made when they are asked for.
};

}  // namespace lmdbench
