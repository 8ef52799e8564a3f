// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/contact.h>
#include <lmdbench/decision/intersection_polylines.h>
#include <lmdbench/decision/intersections.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>
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

/// Finds the exact and complete LMD set in every frame, at one rate. Read in this order: layout/,
/// build/, traverse/ (wide_node_test.h, wide_criteria-inl.h, wide_traversal.h), decide/, keep/,
/// deform/.
///
/// 1. *Enumerate.* Both meshes have a wide hierarchy over the features of their shapes (layout/,
///    build/). Both are descended together; what is left is every pair of features that bounds
///    cannot reject (traverse/wide_traversal.h). A closed-form test in double precision rejects
///    nearly all of these pairs (decide/filter.h).
/// 2. *Decide.* The definition is asked for the other pairs (decision/decide.h), and for corners
///    and chains of triangles that may touch. The latter also tells which triangles intersect
///    (decide/touching_pairs.h).
/// 3. *Join.* The contacts of one place become one LMD (decision/join_contacts.h).
///
/// No LMD is missed: `exhaustive` asks the same definition for all pairs near enough and joins with
/// the same function, so the sets differ only where a bound is wrong. PROOF.md proves the
/// bounds, and ends with what it does not prove.
///
/// From frame to frame (keep/) step 1 reuses its tests, the filter's answers and gaps of triangles:
/// each is valid for some frames if the motion goes on as forecast (wide_lifetime.h). A frame
/// repeats what has run out, and what the motion deviates too far for (motion_forecast.h). Where
/// much must be made or repeated, a frame makes a part of it and is searched from scratch as well;
/// so is one where the pose jumps or little is kept (coherence_policy.h). Where a mesh deforms,
/// tests of nodes that changed are repeated (TraversalFront::follow). The set is the same.
class Certified : public Method {
 public:
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
  /// The same steps over hierarchies that own every feature with an index (CRITICAL.md,
  /// build/signed_hierarchy.h). It keeps tests of its own from frame to frame.
  void find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) override;

  /// From now on searches list every pair of triangles that intersect.
  void list_intersecting_pairs() { lists_intersecting_pairs_ = true; }
  /// Calls visit(pair) for each at the last pose; some twice.
  template <class Visit>
  void for_each_intersecting_pair(Visit&& visit) const {
    for (const CrossingPair& pair : crossing_pairs_) visit(pair);
  }

 private:
  /// The fixed body, its prepared data and what is kept of the pair.
  struct FixedBody {
    const Surface& surface;
    const ShapeComplex& shape;
    const WideHierarchy& hierarchy;
    const SignedFeatures* signs;  ///< Where critical pairs are looked for.
    TraversalFront front;         ///< Empty where nothing is kept.
    CoherencePolicy policy;
    std::uint32_t seen_moving = 0, seen_fixed = 0;  ///< Deformations that the front knows.
    double reach = 0.0;                             ///< For which its tests were made [m].
    std::size_t tests_from_scratch = 0;             ///< Of the last search from scratch.
  };
  struct Frame;

  /// @param with_critical  looks for critical pairs
  Certified(Scene of_pair, const CertifiedOptions& options, WideKernel kernel, bool with_critical);
  /// Steps 1 and 2; calls join(the two at the pose, their contacts, regions at rest).
  template <class Join>
  void find(const Pose& X_WM, WorkCounters& counters, Join&& join);

  // Steps 1 and 2. Instructions are counted by names that begin with `search`
  // (scripts/tuned_constants.py): no other name does.
  bool follow_motion(const RigidTransform& X_WM, double touch, double search_distance);
  void follow_deformations();
  void enumerate_from_scratch(Frame& frame);
  bool advance_kept(Frame& frame);
  void decide_kept(Frame& frame);

  Scene scene_;
  const WideHierarchy& hierarchy_moving_;
  const ShapeComplex& shape_moving_;
  const SignedFeatures* signs_moving_;  ///< Where critical pairs are looked for.
  CertifiedOptions options_;
  FixedBody fixed_;
  bool coherent_;
  bool lists_intersecting_pairs_ = false;
  VectorTarget target_;
  WideKernel kernel_;
  MotionForecast motion_;
  bool has_last_ = false;         ///< The forecast knows the last frame.
  double touch_ = 0.0;            ///< Of the last frame [m].
  std::uint32_t seen_frame_ = 0;  ///< Deformation of the moving mesh before the forecast began.

  std::vector<Intersection> intersections_;
  std::vector<CrossingPair> crossing_pairs_;
  std::unique_ptr<Certified> critical_;  ///< Of find_critical; made when first asked for.
};

}  // namespace lmdbench
