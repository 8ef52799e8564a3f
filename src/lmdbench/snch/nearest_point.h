// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/snch/hierarchy.h>

#include <cstdint>
#include <limits>

namespace lmdbench {

/// The place of a mesh that is nearest to a point.
struct NearestPoint {
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< metres
  std::int32_t triangle = -1;
  PointTriangleDistance place;  ///< In the mesh's frame.
};

/// Exact, by branch and bound over the spheres of the hierarchy.
/// @param p_M          in the mesh's frame
/// @param upper_bound  places beyond it are not looked for; the result then has triangle == -1
NearestPoint nearest_point(const Surface& surface, const Hierarchy& hierarchy, const Vec3& p_M,
                           double upper_bound = std::numeric_limits<double>::infinity());

}  // namespace lmdbench
