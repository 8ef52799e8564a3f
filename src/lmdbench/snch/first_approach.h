// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/snch/hierarchy.h>

#include <cstdint>
#include <limits>

namespace lmdbench {

/// Where a mesh that comes along a line first has a distance.
struct FirstApproach {
  double reach =
      -std::numeric_limits<double>::infinity();  ///< Along the line [m]; none where it never comes so near.
  std::int32_t triangle_moving = -1;             ///< The pair that has it.
  std::int32_t triangle_fixed = -1;
};

/// The largest s at which the moving mesh, displaced by s times a direction, is at a gap from the fixed one: coming
/// from far away it has that gap there for the first time.
///
/// Along a line the distance of two convex sets is a convex function of s, so that Newton's steps from outside end on
/// the first crossing of a triangle pair, none too far, also where the pair passes nearly tangentially. Over all pairs:
/// branch and bound over the spheres of both hierarchies, whose first crossing is a root of a quadratic equation.
/// @param X_WM         pose of the moving mesh at s = 0
/// @param direction_W  unit
/// @param gap          [m], > 0
/// @param tolerance    the gap at the result exceeds `gap` by less than this part of it
/// @param begin        a pair whose crossing is tried first, for speed; -1: none
FirstApproach first_approach(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                             const Hierarchy& fixed_hierarchy, const Pose& X_WM, const Vec3& direction_W,
                             double gap, double tolerance, const FirstApproach& begin = {});

}  // namespace lmdbench
