// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/own_wrench.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/scene/broad_phase.h>
#include <lmdbench/scene/mesh_pair.h>
#include <lmdbench/scene/near_pairs.h>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace lmdbench {

/// A method of two bodies over a scene, whatever moves, deforms or is instanced:
///
/// 1. the broad phase says which pairs of objects may be within reach (broad_phase.h);
/// 2. each is searched in the frame of its second mesh: the method sees the relative pose, in near
///    frames (lmd/near_frame.h); no mesh is copied or placed for an instance;
/// 3. the sets are brought to the world, named by `ObjectPair::number`, sorted by `lmd_less`.
///
/// The set is a union over pairs: contacts of different pairs are never one LMD
/// (decision/DEFINITION.md). Of nearest pairs each mover keeps one: an LMD stays that is nearest
/// for one of its movers. A `frame_coherent` method belongs to one pair from a pool while that is a
/// candidate; else one serves all pairs of two meshes. `brute_force` methods are truth: they look
/// at the spheres of all pairs in every frame, without the broad phase. The object with the lower
/// number is the moving mesh, so orders of objects and trees do not matter.
///
/// A scene of one pair is asked as it is: no broad phase, and no set is copied.
class SceneSearch : public Method, public HasOwnWrench {
 public:
  /// @param description of the method that `make` makes
  SceneSearch(const Scene& scene, const MethodDescription& description, MeshPair::Make make,
              const BroadPhase::Tuning& tuning = {});
  SceneSearch(const SceneSearch&) = delete;
  SceneSearch& operator=(const SceneSearch&) = delete;

  const MethodDescription& description() const override { return description_; }
  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  /// A set follows the motion wherever its pairs are: no broad phase.
  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override;
  void find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) override;
  /// The sum over the pairs of a mesh that moves.
  std::optional<OwnWrench> own_wrench(std::size_t mover) const override { return own_[mover]; }

  /// Pairs that are kept: those that motion within the slack can bring within reach.
  std::size_t candidate_count() const { return phase_ ? phase_->candidates().size() : 0; }
  /// Methods that were made: of pairs that are or were near.
  std::size_t method_count() const;

 private:
  using Meshes = std::pair<const Body*, const Body*>;
  Meshes meshes_of(const ObjectPair& pair) const;
  /// Of the pair's meshes, as they are now.
  MeshPair& methods_of(const ObjectPair& pair);
  /// Calls ask(pair, method, place) for each pair of objects that may be within reach.
  template <class Ask>
  void for_each_near(const Pose& X_WM, WorkCounters& counters, const Ask& ask);
  /// Calls find(method, X_FM, set) for them and unites the sets.
  template <class Set, class Find>
  void gather(const Pose& X_WM, Set& of_pair, Set& set, WorkCounters& counters, const Find& find);
  void add_own_wrench(const Method& method, const ObjectPair& pair, const PlacedPair& place);
  void keep_nearest_of_each_mover(LmdSet& lmds);

  std::shared_ptr<const Scene> scene_;
  MethodDescription description_;
  const MeshPair::Make make_;
  std::map<Meshes, MeshPair> methods_;
  MeshPair* pair_ = nullptr;  ///< Of a scene of one pair, which is asked as it is.
  std::optional<BroadPhase> phase_;
  std::optional<NearPairs> all_;  ///< Of truth, in place of the broad phase.
  LmdSet of_pair_, tracked_;
  CriticalSet critical_of_pair_;
  const bool has_own_force_;
  std::vector<std::optional<OwnWrench>> own_;  ///< One a mover.
  std::vector<bool> has_nearest_;              ///< One a mover.
};

/// The method with what a scene of other than one pair counts: movers that left their slack
/// (queries of trees); pairs whose bounds were placed or room was used up; pairs searched.
MethodDescription over_scene(MethodDescription description);

}  // namespace lmdbench
