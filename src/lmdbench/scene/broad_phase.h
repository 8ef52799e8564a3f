// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/scene.h>
#include <lmdbench/scene/instance_tree.h>
#include <lmdbench/scene/mesh_bounds.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace lmdbench {

/// How far any point of a placed mesh can have come between two poses: the way of its centre, and twice the radius by the sine of half
/// the turn (the chord of the farthest point), grown by rounding [m].
double farthest_motion(const MeshBounds& bounds, const Pose& from, const Pose& to);

/// Slack of a broad phase over the radius of the moving mesh: less asks the tree more often, more finds more candidates. Swept by
/// `lmdbench-study worlds --slack`.
inline constexpr double BROAD_PHASE_SLACK = 0.25;

/// Which instances of a world may be within reach of the moving mesh, frame after frame.
///
/// A query of the tree reaches farther than asked, by the *slack*, and orders what it finds, the *candidates*, by their *room*: by how
/// much they were farther away than the reach, as their boxes tell. As long as no point of the moving mesh is farther than the slack from
/// where it was at the query, an instance that is no candidate is out of reach, and so is a candidate whose room is not used up
/// (PROOF.md here, W2). A candidate whose room is used up for the first time gets a larger one, where the spheres of the outlines
/// (mesh_bounds.h) were farther apart at the query than the boxes. So a frame looks at the candidates whose room is used up and at no
/// other instance.
class BroadPhase {
 public:
  struct Candidate {
    std::uint32_t instance = 0;
    double room = 0.0;        ///< [m]
    bool by_outline = false;  ///< The room is what outlines tell.
  };

  /// What frames cost.
  struct Work {
    std::uint64_t queries = 0;  ///< Of the tree.
    std::uint64_t touched = 0;  ///< Instances whose bounds were placed, or whose room was found used up.
  };

  /// @param slack over the radius of the moving mesh
  explicit BroadPhase(const Scene& scene, double slack = BROAD_PHASE_SLACK);

  /// Brings it to a pose.
  /// @return whether the tree was asked: then the candidates are others
  bool advance(const Pose& X_WM, Work& work);

  /// Since the last query; by room, then by index.
  const std::vector<Candidate>& candidates() const { return candidates_; }
  /// That many of the candidates, the first ones, may be within reach; the others are not.
  std::size_t near_count() const { return near_count_; }

  /// What truth goes by: every instance's sphere at this pose, without tree and memory.
  /// @param near receives the indices of those that may be within reach, ascending
  void look_at_all(const Pose& X_WM, std::vector<std::uint32_t>& near) const;

  /// Calls visit(instance, bound) by the distance of the instance's box from the moving mesh's centre, until it returns false; `bound` [m] is
  /// a lower bound of the distance of the meshes, and of all that would follow. For what looks for the nearest instance.
  void by_distance(const Pose& X_WM,
                   const std::function<bool(std::uint32_t instance, double bound)>& visit) const;

  /// The meshes, each once.
  const std::vector<std::shared_ptr<const Body>>& meshes() const { return meshes_; }
  std::size_t mesh_of(std::uint32_t instance) const { return mesh_[instance]; }
  const Pose& pose_of(std::uint32_t instance) const { return poses_[instance]; }
  std::size_t size() const { return poses_.size(); }
  /// Contacts are looked for up to here, the cutoff and the tolerances of the definition [m].
  double reach() const { return reach_; }

 private:
  /// Lower bound of the distance of the placed moving mesh from an instance, less the reach [m].
  double room_of(std::uint32_t instance, const RigidTransform& X_WM, const Eigen::AlignedBox3d& box) const;
  double room_by_outline(std::uint32_t instance) const;
  void ask(const Pose& X_WM, Work& work);

  std::vector<std::shared_ptr<const Body>> meshes_;
  std::vector<const MeshBounds*> bounds_;     ///< One a mesh.
  std::vector<const MeshOutline*> outlines_;  ///< One a mesh.
  std::vector<std::uint32_t> mesh_;           ///< One an instance.
  std::vector<Pose> poses_;                   ///< X_WF, one an instance.
  MeshBounds moving_;
  const MeshOutline* moving_outline_;
  double reach_ = 0.0, slack_ = 0.0;
  InstanceTree tree_;
  bool has_asked_ = false;
  Pose asked_at_;
  std::vector<Candidate> candidates_;
  std::size_t near_count_ = 0;
  std::vector<std::uint32_t> found_;
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
