// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/snch/hierarchy.h>

#include <cstdint>
#include <limits>

namespace lmdbench {

/// Nearest triangle pair of two meshes.
struct NearestPair {
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< metres; 0: crossing
  std::int32_t triangle_moving = -1;
  std::int32_t triangle_fixed = -1;
  TrianglePairDistance pair;  ///< in world coordinates; a is the moving triangle
};

/// Exact minimum distance by branch and bound over the spheres of both hierarchies, without cones.
/// @param upper_bound largest distance sought; if all are above, triangle_moving == -1
NearestPair nearest_pair(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                         const Hierarchy& fixed_hierarchy, const Pose& X_WM,
                         double upper_bound = std::numeric_limits<double>::infinity());

/// Whether the meshes are within `distance` [m]: stops at the first such triangle pair.
bool within_distance(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                     const Hierarchy& fixed_hierarchy, const Pose& X_WM, double distance);

/// Exact nearest pairs of two meshes along a path. The last search's triangles at the new pose
/// bound the next one, for speed alone: the distance has the same bits as from scratch; of equally
/// near pairs it may name another. Remembers its last pair, so use it from one thread.
class NearestTracker {
 public:
  /// The meshes and hierarchies must outlive this.
  NearestTracker(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                 const Hierarchy& fixed_hierarchy)
      : moving_(moving),
        fixed_(fixed),
        moving_hierarchy_(moving_hierarchy),
        fixed_hierarchy_(fixed_hierarchy) {}

  /// As `nearest_pair` without a bound.
  NearestPair nearest(const Pose& X_WM);

  /// The last pair at another pose; triangle_moving is -1 before the first search.
  NearestPair last_pair(const Pose& X_WM) const;

 private:
  const Surface& moving_;
  const Surface& fixed_;
  const Hierarchy& moving_hierarchy_;
  const Hierarchy& fixed_hierarchy_;
  std::int32_t last_moving_ = -1;
  std::int32_t last_fixed_ = -1;
};

/// The point of a mesh nearest to a given point.
struct NearestPoint {
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< metres
  std::int32_t triangle = -1;
  PointTriangleDistance place;  ///< In the mesh's frame.
};

/// Exact, by branch and bound over the spheres of the hierarchy.
/// @param p_M          in the mesh's frame
/// @param upper_bound  largest distance sought; if all are above, triangle == -1
NearestPoint nearest_point(const Surface& surface, const Hierarchy& hierarchy, const Vec3& p_M,
                           double upper_bound = std::numeric_limits<double>::infinity());

}  // namespace lmdbench
