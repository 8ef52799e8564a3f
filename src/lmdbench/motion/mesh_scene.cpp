// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/motion/mesh_scene.h>
#include <lmdbench/snch/first_approach.h>
#include <lmdbench/snch/hierarchy.h>
#include <lmdbench/snch/minimum_distance.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace lmdbench {
namespace {

class MeshPair {
 public:
  MeshPair(TriangleMesh moving, TriangleMesh fixed)
      : moving_(build_surface(std::move(moving))),
        fixed_(build_surface(std::move(fixed))),
        moving_hierarchy_(Hierarchy::of(moving_)),
        fixed_hierarchy_(Hierarchy::of(fixed_)),
        tracker_(moving_, moving_hierarchy_, fixed_, fixed_hierarchy_) {}

  double distance(const Pose& X_WM) { return tracker_.nearest(X_WM).distance; }

  FirstApproach approach(const Pose& X_WM, const Vec3& direction_W, double gap) {
    last_approach_ = first_approach(moving_, moving_hierarchy_, fixed_, fixed_hierarchy_, X_WM, direction_W,
                                    gap, GAP_TOLERANCE, last_approach_);
    return last_approach_;
  }

 private:
  Surface moving_;
  Surface fixed_;
  Hierarchy moving_hierarchy_;
  Hierarchy fixed_hierarchy_;
  NearestTracker tracker_;
  FirstApproach last_approach_;
};

}  // namespace

PathScene mesh_scene(TriangleMesh moving, TriangleMesh fixed) {
  PathScene scene;
  scene.diagonal = bounding_box_diagonal(moving);
  scene.moving_centre_M = bounding_box_centre(moving);
  scene.fixed_centre_W = bounding_box_centre(fixed);
  scene.moving_radius = radius_about(moving, scene.moving_centre_M);
  scene.fixed_radius = radius_about(fixed, scene.fixed_centre_W);
  const auto pair = std::make_shared<MeshPair>(std::move(moving), std::move(fixed));
  scene.distance = [pair](const Pose& X_WM) { return pair->distance(X_WM); };
  const Vec3 moving_centre_M = scene.moving_centre_M, fixed_centre_W = scene.fixed_centre_W;
  scene.centre_distance = [pair, moving_centre_M, fixed_centre_W](
                              const Vec3& direction_W, const Eigen::Quaterniond& rotation, double gap) {
    const Pose centred{fixed_centre_W - rotation * moving_centre_M, rotation};
    return std::max(0.0, pair->approach(centred, direction_W, gap).displacement);
  };
  return scene;
}

}  // namespace lmdbench
