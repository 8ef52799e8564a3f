// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <span>
#include <vector>

namespace lmdbench {

/// Rays whose conical hull contains the polar { n : n . e <= 0 for every e } of a set of
/// directions, widened by a tolerance: their hull covers { n : |n| = 1, n . e <= tolerance for
/// every e }. Empty where that set is.
///
/// The widened set is cut out of the unit sphere by circles n . e = tolerance. It is bounded by arcs of
/// them, and, as any two circles of directions that are not parallel cross, it has a corner where two
/// circles cross or it is empty. So all crossings are tried against all directions: no polygon is
/// carried along, no order matters, and needles, straight edges, flat and coplanar sets need no cases.
/// Cubic in the worst case, quadratic in practice because a crossing outside is rejected by the
/// direction that rejected the one before.
///
/// Of more than 128 directions only some are taken, at first the outermost ones, then those that the rays so far
/// violate most, until the rays are good to twice the tolerance or there are enough: the set of fewer directions
/// is larger, so the rays still cover the cone, and whether it is empty is decided by all directions. A fat round
/// cone of thousands of directions so gets some hundred rays that reach a few thousandths of its width too far;
/// the work is linear in the number of directions.
/// @param directions  unit vectors; parallel ones allowed; none at all gives all directions
/// @param outer       if not zero: rays with n . outer < -tolerance are left out
/// @param first_only  stop at the first ray: only asks whether the set is empty
std::vector<Vec3> polar_rays(std::span<const Vec3> directions, const Vec3& outer, double tolerance,
                             bool first_only = false);

}  // namespace lmdbench
