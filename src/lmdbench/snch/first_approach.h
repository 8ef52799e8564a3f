// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/snch/hierarchy.h>

#include <cstdint>
#include <limits>

namespace lmdbench {

/// The first place at which a mesh on a line has a given distance.
struct FirstApproach {
  /// Along the line [m]; -infinity where the mesh never comes so near.
  double displacement = -std::numeric_limits<double>::infinity();
  std::int32_t triangle_moving = -1;  ///< The pair with that distance.
  std::int32_t triangle_fixed = -1;
};

/// The largest s at which the moving mesh, displaced by s times a direction, has a gap from the
/// fixed one: coming from far away it has that gap there for the first time.
///
/// Along a line the distance of two convex sets is a convex function of s. So Newton's steps from
/// outside end on a triangle pair's first crossing without going too far, even if nearly
/// tangential. Over all pairs: branch and bound over the spheres (first crossing: a quadratic).
/// @param X_WM         pose of the moving mesh at s = 0
/// @param direction_W  unit
/// @param gap          [m], > 0
/// @param tolerance    the gap at the result exceeds `gap` by less than this part of it
/// @param begin        pair to try first, for speed; -1: none
FirstApproach first_approach(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                             const Hierarchy& fixed_hierarchy, const Pose& X_WM, const Vec3& direction_W,
                             double gap, double tolerance, const FirstApproach& begin = {});

}  // namespace lmdbench
