// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/snch/hierarchy.h>

#include <cstdint>
#include <limits>

namespace lmdbench {

/// Nearest triangle pair of two meshes.
struct NearestPair {
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< metres; 0 when the meshes intersect
  std::int32_t triangle_moving = -1;
  std::int32_t triangle_fixed = -1;
  TrianglePairDistance pair;  ///< in world coordinates; a is the moving triangle
};

/// Exact minimum distance by branch and bound over the spheres of both hierarchies (cones are not used).
/// @param upper_bound distances above this are not looked for; the result then has triangle_moving == -1
NearestPair nearest_pair(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                         const Hierarchy& fixed_hierarchy, const Pose& X_WM,
                         double upper_bound = std::numeric_limits<double>::infinity());

/// Whether the meshes are within `distance` [m] of each other: stops at the first triangle pair that is.
bool within_distance(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                     const Hierarchy& fixed_hierarchy, const Pose& X_WM, double distance);

}  // namespace lmdbench
