// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/prepare/scene_frames.h>
#include <lmdbench/scene/broad_phase.h>
#include <lmdbench/scene/near_pairs.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace lmdbench {

/// Bounds how far a point of the moving mesh moves between two poses.
class MotionBound {
 public:
  /// Relative rounding error of such a bound.
  static constexpr double ROUNDING = 1e-12;

  /// @param farther largest distance of a deformed point from its place in the mesh [m]
  explicit MotionBound(const TriangleMesh& mesh, double farther = 0.0)
      : centre_(bounding_box_centre(mesh)), radius_(radius_about(mesh, centre_) + farther) {}

  /// Distance moved by the centre, plus the chord of the point farthest from it as the mesh turns.
  double between(const Pose& a, const Pose& b) const {
    const double way = (RigidTransform(b).point(centre_) - RigidTransform(a).point(centre_)).norm();
    const double half_turn_sine = (a.rotation.conjugate() * b.rotation).vec().norm();
    return way + 2.0 * radius_ * std::min(half_turn_sine, 1.0);
  }
  /// Rounding error of that, at poses as far from the origin as these.
  double slack(const Pose& a, const Pose& b) const {
    return ROUNDING * (radius_ + centre_.norm() + a.translation.norm() + b.translation.norm());
  }

 private:
  Vec3 centre_;
  double radius_;
};

/// The exact distance of deforming meshes, frame by frame. For a frame without a search it is
/// bounded by the last search and the motion and deformation since.
class DeformingDistance {
 public:
  /// @pre one mesh moves, past others that are not placed
  DeformingDistance(const Scene& rest, const SceneMotion& motion);

  /// The distance, however far; 0 where triangles touch or intersect [m].
  double look(std::int64_t frame, const Pose& X_WM);

  /// Bounds of a distance [m].
  struct Interval {
    double least = 0.0, most = std::numeric_limits<double>::infinity();
  };
  Interval known(std::int64_t frame, const Pose& X_WM) const;

 private:
  SceneFrames bodies_;
  std::shared_ptr<const SceneDeformation> deformation_;
  MotionBound motion_;  ///< Of the moving mesh in all of its shapes.
  std::optional<Pose> looked_at_;
  std::int64_t frame_ = 0;  ///< Of the last search.
  double distance_ = 0.0;   ///< There [m].
};

/// As `frames_in_contact` below, each frame with its shape.
/// @param forecast whether frames with known contact skip the search: the answer is the same
std::vector<bool> frames_in_contact(const Scene& rest, const SceneMotion& motion,
                                    const std::vector<Pose>& poses, bool forecast = true);

/// Exact distances of a scene's nearest objects, one of them moving; tests pairs with near spheres.
class NearestObjects {
 public:
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();  ///< [m]; 0: touching or crossing.
    ObjectPair objects;
    std::int32_t triangle_moving = -1;  ///< -1: no pair within the bound.
    std::int32_t triangle_fixed = -1;
  };

  /// @param scene must outlive this
  explicit NearestObjects(const Scene& scene) : scene_(scene), near_(scene) {}

  /// Of equal distances the pair with the nearer spheres.
  /// @param bound distances above this are not looked for [m]
  Nearest at(const Pose& X_WM, double bound = std::numeric_limits<double>::infinity());
  /// Whether any two objects are that near.
  bool any_within(const Pose& X_WM, double distance);

 private:
  const Scene& scene_;
  NearPairs near_;
};

/// Exact minimum distance of a scene of any kind, in its frames one after the other.
class SceneDistance {
 public:
  SceneDistance(const Scene& rest, const SceneMotion& motion);

  /// @param bound distances known to be above this are not computed: infinity [m]
  double at(std::int64_t frame, const Pose& X_WM, double bound = std::numeric_limits<double>::infinity());

 private:
  SceneFrames frames_;
  std::optional<DeformingDistance> deforming_;
  std::optional<BroadPhase> phase_;
  std::optional<NearestObjects> objects_;
};

/// "In contact", the one definition: whether the meshes of a pose are within the cutoff of each
/// other, so that there is a force. It depends on scene and path alone: statistics over frames in
/// contact are over the same frames for every method. Triangles that intersect or touch at distance
/// 0 are "touching", a part of it.
/// @param forecast whether a frame skips the search if an earlier one and a bound on the motion
/// since decide it: the answer is the same
std::vector<bool> frames_in_contact(const Scene& scene, const std::vector<Pose>& poses, bool forecast = true);

/// Exact minimum distance to the fixed meshes, none of which is placed [m]; 0 where triangles touch
/// or intersect, infinite where none is within the bound.
/// @param bound distances above this are not looked for [m]
double nearest_distance(const Scene& scene, const Pose& X_WM,
                        double bound = std::numeric_limits<double>::infinity());

/// Distances of the meshes along a path.
struct Clearance {
  /// Exact at any size; 0 where triangles touch or intersect.
  double least_m = std::numeric_limits<double>::infinity();
  std::int64_t touching = 0;  ///< Poses at which they touch or intersect.
};

/// Of all poses, exactly. A pose is measured only if, by a bound on the motion since the last
/// measured one, it could be below the least so far.
Clearance clearance(const Scene& scene, std::span<const Pose> poses);

}  // namespace lmdbench
