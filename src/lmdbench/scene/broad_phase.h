// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/scene/instance_tree.h>
#include <lmdbench/scene/mesh_bounds.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace lmdbench {

/// Bound [m] of how far a placed mesh's points move between two poses: the centre's way plus 2
/// radius sin(turn / 2) (chord of the farthest point), grown by rounding.
double farthest_motion(const MeshBounds& bounds, const Pose& from, const Pose& to);

/// Pairs of a scene's objects that may be within reach, frame after frame (PROOF.md here, W2, W4).
///
/// A mover has an *anchor*, an earlier pose, and a box that holds it while no point is farther than
/// its *slack* from there, grown by half the reach. What stands is anchored for good, without
/// slack. Objects with separate boxes are out of reach within their slack. Others are *candidates*.
/// Their *room* is the gap of their boxes at the anchors less the reach. A frame looks only at
/// pairs whose motions have used it up, and first enlarges it by the spheres of the outlines
/// (mesh_bounds.h). A mover that leaves its slack is anchored anew, alone, with box and candidates.
/// So what is far or rests costs a comparison; an instance that stands costs its box in the tree.
class BroadPhase {
 public:
  /// Swept by `lmdbench-study worlds`, parts `slack` and `pile-slack`.
  struct Tuning {
    double slack = 0.25;  ///< Over the mover's radius: small: many anchors; large: many pairs.
    double pack_share =
        0.1;  ///< Where more of the movers leave their slack in a frame, the tree is packed anew.
  };

  struct Candidate : ObjectPair {
    double room = 0.0;                 ///< [m]
    bool by_outline = false;           ///< The room is what outlines tell.
    std::unique_ptr<Method> method{};  ///< Kept here by the search while the pair is a candidate.
  };

  /// What frames cost.
  struct Work {
    std::uint64_t queries = 0;  ///< Of the trees: movers that left their slack.
    std::uint64_t touched = 0;  ///< Pairs whose bounds were placed or whose room was used up.
  };

  explicit BroadPhase(const Scene& scene) : BroadPhase(std::make_shared<const Scene>(scene), Tuning{}) {}
  BroadPhase(std::shared_ptr<const Scene> scene, const Tuning& tuning);

  /// Brings it to a frame and to the present shapes of bodies.
  /// @param X_WM of `Scene::moving`; `Scene::mover_poses` says where the others are
  void advance(const Pose& X_WM, Work& work);

  /// Calls visit(candidate) for each pair that may be within reach, by mover, then by other.
  template <class Visit>
  void for_each_near(Work& work, Visit&& visit) {
    for (Candidate& candidate : candidates_)
      if (is_near(candidate, work)) visit(candidate);
  }

  /// By mover, then by other.
  std::vector<Candidate>& candidates() { return candidates_; }
  const std::vector<Candidate>& candidates() const { return candidates_; }
  /// Candidates with a method that are none any more; whoever searches empties it.
  std::vector<Candidate>& dropped() { return dropped_; }

  /// Calls visit(instance, bound) for what stands, by the distance of boxes to the moving centre,
  /// until false; `bound` [m] is a lower bound of this and all later distances of meshes.
  void by_distance(const Pose& X_WM,
                   const std::function<bool(std::uint32_t instance, double bound)>& visit) const;

 private:
  struct Mesh {
    std::shared_ptr<const Body> body;
    const MeshBounds* bounds;
    const MeshOutline* outline;
  };
  struct Mover {
    Pose anchor;
    Eigen::AlignedBox3d box;  ///< At the anchor.
    double slack = 0.0;       ///< [m]
    double motion = 0.0;      ///< Since the anchor [m].
    bool is_stale = true;     ///< It is anchored in this frame.
  };

  void begin();
  void follow_deformation();
  const Mesh& mesh_of(std::uint32_t object) const { return meshes_[mesh_[object]]; }
  const MeshBounds& bounds_of(std::uint32_t object) const { return *mesh_of(object).bounds; }
  const Pose& anchor_of(std::uint32_t object) const;
  Eigen::AlignedBox3d box_of(std::uint32_t object) const;
  double slack_of(std::uint32_t object) const {
    return object < movers_.size() ? movers_[object].slack : 0.0;
  }
  double motion_of(std::uint32_t object) const {
    return object < movers_.size() ? movers_[object].motion : 0.0;
  }
  bool is_stale(std::uint32_t object) const { return object < movers_.size() && movers_[object].is_stale; }
  Eigen::AlignedBox3d grown_box(std::uint32_t mover, double more) const;
  void anchor(const Pose& X_WM, Work& work);
  void find_candidates(std::uint32_t mover, Work& work);
  void merge_found();
  double rounding_of(std::uint32_t a, std::uint32_t b) const;
  double room_of(std::uint32_t a, std::uint32_t b) const;
  double room_by_outline(std::uint32_t a, std::uint32_t b) const;
  bool is_near(Candidate& candidate, Work& work) const;

  std::shared_ptr<const Scene> scene_;
  Tuning tuning_;
  double reach_ = 0.0;
  std::vector<Mesh> meshes_;         ///< Each once.
  std::vector<std::uint32_t> mesh_;  ///< One an object.
  std::vector<Mover> movers_;
  bool has_anchors_ = false;
  std::optional<InstanceTree> moving_tree_;  ///< Of several movers' grown boxes.
  std::optional<InstanceTree> standing_tree_;
  std::vector<Eigen::AlignedBox3d> grown_;  ///< One a mover: what the tree has.
  std::vector<std::uint32_t> stale_, touching_;
  std::vector<Candidate> candidates_, found_, merged_, dropped_;
  std::uint64_t deformations_ = 0;  ///< Of all meshes, that are taken in.
};

/// The nearest of a world's instances.
struct NearestInstance {
  std::int32_t instance = -1;                                 ///< -1: none within the bound.
  double distance = std::numeric_limits<double>::infinity();  ///< [m]; 0 if meshes intersect.
  std::int32_t triangle_moving = -1;
  std::int32_t triangle_fixed = -1;
};

/// Exact minimum distance to a scene's fixed meshes, each at its pose (snch/minimum_distance.h),
/// nearest boxes first; of equally near instances the first by index.
/// @param phase of the same scene
/// @param bound distances above this are not looked for [m]
NearestInstance nearest_instance(const Scene& scene, const BroadPhase& phase, const Pose& X_WM,
                                 double bound = std::numeric_limits<double>::infinity());

}  // namespace lmdbench
