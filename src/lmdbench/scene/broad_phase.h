// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/scene/instance_tree.h>
#include <lmdbench/scene/mesh_bounds.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace lmdbench {

/// How far any point of a placed mesh can have come between two poses: the way of its centre, and twice the radius by the sine of half
/// the turn (the chord of the farthest point), grown by rounding [m].
double farthest_motion(const MeshBounds& bounds, const Pose& from, const Pose& to);

/// Which pairs of a scene's objects may be within reach, frame after frame.
///
/// Every mover has an *anchor*, a pose that it had, and around it a box that holds it as long as no point of it is farther than its *slack*
/// from where it was there, grown by half the reach; what stands is anchored for good, without slack. Objects whose boxes are apart are out
/// of reach of each other, whatever they do within their slack. The others are *candidates*, with the *room* that they had at their
/// anchors: by how much they were farther apart than the reach, as their boxes tell. A frame looks at those whose room the motions of both
/// have used up; for the first time it gives them a larger one, where the spheres of the outlines (mesh_bounds.h) were farther apart than
/// the boxes. What leaves its slack is anchored where it is, alone: its box, its candidates. So neither what is far nor what rests costs
/// more than a comparison, and an instance that stands no more than its box in the tree (PROOF.md here, W2 and W4).
class BroadPhase {
 public:
  /// Swept by `lmdbench-study worlds`, parts `slack` and `pile-slack`.
  struct Tuning {
    double slack = 0.25;  ///< Over the mover's radius: less anchors more often, more has more candidates.
    double pack_share =
        0.1;  ///< Where more of the movers leave their slack in a frame, the tree is packed anew.
  };

  struct Candidate : ObjectPair {
    double room = 0.0;                 ///< [m]
    bool by_outline = false;           ///< The room is what outlines tell.
    std::unique_ptr<Method> method{};  ///< Whoever searches keeps it here while the pair is a candidate.
  };

  /// What frames cost.
  struct Work {
    std::uint64_t queries = 0;  ///< Of the trees: movers that left their slack.
    std::uint64_t touched = 0;  ///< Pairs whose bounds were placed, or whose room was found used up.
  };

  explicit BroadPhase(const Scene& scene) : BroadPhase(std::make_shared<const Scene>(scene), Tuning{}) {}
  BroadPhase(std::shared_ptr<const Scene> scene, const Tuning& tuning);

  /// Brings it to a frame, and to what bodies have deformed to since.
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

  /// Of what stands: calls visit(instance, bound) by the distance of the instance's box from the centre of the moving mesh, until it returns
  /// false; `bound` [m] is a lower bound of the distance of the meshes, and of all that would follow. For what looks for the nearest one.
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
  std::optional<InstanceTree> moving_tree_;  ///< Of the movers' grown boxes, where there are several.
  std::optional<InstanceTree> standing_tree_;
  std::vector<Eigen::AlignedBox3d> grown_;  ///< One a mover: what the tree has.
  std::vector<std::uint32_t> stale_, touching_;
  std::vector<Candidate> candidates_, found_, merged_, dropped_;
  std::uint64_t deformations_ = 0;  ///< Of all meshes, that are taken in.
};

/// The nearest of a world's instances.
struct NearestInstance {
  std::int32_t instance = -1;                                 ///< -1 where none is within the bound.
  double distance = std::numeric_limits<double>::infinity();  ///< [m]; 0 where the meshes intersect.
  std::int32_t triangle_moving = -1;
  std::int32_t triangle_fixed = -1;
};

/// Exact minimum distance to a scene's fixed meshes, each at its pose (snch/minimum_distance.h), nearest boxes first. Of instances that
/// are equally near the first by index.
/// @param phase of the same scene
/// @param bound distances above this are not looked for [m]
NearestInstance nearest_instance(const Scene& scene, const BroadPhase& phase, const Pose& X_WM,
                                 double bound = std::numeric_limits<double>::infinity());

}  // namespace lmdbench
