// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/intersection_polylines.h>
#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/plateau.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/methods/certified/coherence/coherence_policy.h>
#include <lmdbench/methods/certified/coherence/traversal_front.h>
#include <lmdbench/methods/certified/filter.h>
#include <lmdbench/methods/certified/flat/flat_contacts.h>
#include <lmdbench/methods/certified/hierarchy/wide_traversal.h>
#include <lmdbench/methods/certified/options.h>

#include <cstdint>
#include <memory>
#include <span>
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
/// Flat contact: a region of faces in one plane and a line of edges are one feature each (flat_mesh.h), so
/// that tessellation costs nothing. Two of them are parallel, and their sets of minimisers are found whole
/// from the outlines (flat_contacts.h); or they have one candidate point, and the faces or edges there decide
/// as above; or rounding decides, or contacts of several of them touch, and then all their triangle pairs are evaluated.
/// Where a tilt of less than 1e-8 decides, in a scene without a planar tolerance, the whole frame is searched by single
/// faces and edges.
///
/// Deep contact: triangles that cross are looked at in vectors (triangle_contact_batch.h); a frame's work there is
/// proportional to the length of the curve in which the meshes intersect.
///
/// The merging of plateaus is the truth's, and it sees the same minima.
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

  /// What a leaf of the hierarchies is where faces lie in one plane or edges on one line.
  enum class FlatFeatures : std::uint8_t {
    JOINED,  ///< The region, the straight edge.
    SINGLE   ///< Each face, each edge: as slow as the tessellation is fine.
  };

  /// @param kernel form of the node test where the frame is searched from scratch
  explicit Certified(Scene scene, const CertifiedOptions& options = {},
                     WideKernel kernel = WideKernel::VECTOR, FlatFeatures flat = FlatFeatures::JOINED);

  const MethodDescription& description() const override { return certified_method(); }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    search(X_WM, lmds, counters);
  }

  /// Calls visit(pair) for every pair of triangles that shared a point at the last pose; some more than once.
  template <class Visit>
  void for_each_intersecting_pair(Visit&& visit) const {
    if (in_doubt_) {
      by_single_features_->for_each_intersecting_pair(visit);
      return;
    }
    for (const Intersection& crossing : crossings_)
      visit(CrossingPair{crossing.fixed_body, crossing.triangle_moving, crossing.triangle_fixed});
    for (const CrossingPair& pair : touching_pairs_) visit(pair);
  }

 private:
  struct TrianglePair {
    std::int32_t moving, fixed;
    auto operator<=>(const TrianglePair&) const = default;
  };
  /// A pair that its triangles decide.
  struct PendingPair {
    TrianglePair triangles;
    bool has_vertex = true;  ///< Of a vertex and something: no piece of a parallel contact.
    auto operator<=>(const PendingPair&) const = default;
  };

  /// A fixed body in a frame.
  struct Frame {
    std::int32_t body;
    const PairFilter& filter;         ///< Of flat features, by their leads.
    const PairFilter& single_filter;  ///< Of single faces and edges.
    const FlatSide& flat_moving;
    const FlatSide& flat_fixed;
    double tolerance;  ///< parallel_tolerance
    bool is_flat;      ///< Some flat feature has more than one face or edge, or
                       ///< there is a tolerance.
  };

  Certificate decide(const Frame& frame, const WidePair& candidate, double lever_arm, WorkCounters& counters);
  void settle(const Frame& frame, const FeatureId& on_moving, const FeatureId& on_fixed,
              const PairAnswer& answer, WorkCounters& counters);
  struct TouchBatch;
  template <class Plan>
  void decide_touching(const Frame& frame, WorkCounters& counters, Plan&& plan);
  void decide_pending(const Frame& frame, std::size_t first, WorkCounters& counters);
  bool evaluate(const Frame& frame, const TrianglePair& pair, LocalMinimum& minimum, WorkCounters& counters);

  // certified_flat.cpp
  bool decide_flat(const Frame& frame, const FeatureId& on_moving, const FeatureId& on_fixed,
                   WorkCounters& counters);
  bool decide_edges(const Frame& frame, const FeatureId& on_moving, const FeatureId& on_fixed, bool joined,
                    WorkCounters& counters);
  bool decide_vertex(const Frame& frame, const FeatureId& on_moving, const FeatureId& on_fixed, bool joined,
                     WorkCounters& counters);
  void decide_single(const Frame& frame, const FeatureId& on_moving, const FeatureId& on_fixed,
                     WorkCounters& counters);
  void expand_faces(const Frame& frame, std::int32_t region_moving, std::int32_t region_fixed);
  void find_faces_near(const FlatSide& side, std::int32_t region, const FlatSide& other,
                       std::span<const std::int32_t> vertices, double reach);
  void expand_edge_face(const Frame& frame, const FlatSide& of_edge, std::int32_t straight,
                        const FlatSide& of_face, std::int32_t region);
  void expand_edges(const Frame& frame, std::int32_t straight_moving, std::int32_t straight_fixed);
  Certificate decide_touching_flat(const Frame& frame, const WidePair& candidate, WorkCounters& counters);
  void settle_touching_contacts(const Frame& frame, std::size_t first, WorkCounters& counters);
  void decide_again(const Frame& frame, std::size_t first, WorkCounters& counters);
  void settle_contacts_beside(const Frame& frame, std::size_t first, std::span<const LocalMinimum> touching,
                              WorkCounters& counters);
  void take_contacts(const Frame& frame, std::size_t first);

  void report(const RigidTransform& X_WM, double coordinates, LmdSet& lmds);

  Scene scene_;
  bool joins_flat_;
  const WideHierarchy& hierarchy_moving_;
  std::vector<const WideHierarchy*> hierarchies_fixed_;  ///< One a fixed body.
  const FlatMesh* flat_moving_;
  std::vector<const FlatMesh*> flat_fixed_;  ///< One a fixed body.
  bool coherent_;
  VectorTarget target_;
  WideKernel kernel_;
  double touch_ = 0.0;
  WideScratch scratch_;
  std::vector<PendingPair> pending_;
  FlatPieces flat_pieces_;  ///< Parallel contacts that are left to their triangles.
  std::vector<LocalMinimum> minima_, of_touching_;
  std::vector<Intersection> crossings_;            ///< Of triangles that clearly cross.
  std::vector<CrossingPair> touching_pairs_;       ///< Others that share a point.
  bool in_doubt_ = false;                          ///< The last frame was searched by single features.
  FlatContacts contacts_;                          ///< Of one fixed body.
  std::vector<WidePair> flat_candidates_;          ///< What the filter left, where contacts_ is asked.
  LmdSet plateaus_;                                ///< The contacts of all.
  std::unique_ptr<Certified> by_single_features_;  ///< Made when the first frame needs it.
  std::vector<std::int32_t> single_, corners_, fixed_corners_, near_;
  std::vector<Vec3> points_;
  /// Pairs of faces that may touch, and their places in the traversal that is kept.
  std::vector<std::pair<WidePair, std::uint32_t>> touching_;

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
