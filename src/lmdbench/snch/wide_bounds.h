// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/snch/polar_cap.h>

#include <span>

namespace lmdbench {

/// Circular cone around caps, none of which is all directions; all directions when it would be wider than 90
/// degrees (decision E1: such a cone would not be convex). Nearly the smallest: `steps` steps from the mean
/// axis towards the cap that sticks out most (M. Badoiu, K. Clarkson, "Smaller core-sets for balls", 2003, on
/// the sphere).
PolarCap enclosing_cap(std::span<const PolarCap> caps, int steps);

/// Centre of a disc-like body that holds the points: it halves their extent along the axis, and across the
/// axis it is nearly the centre of the smallest sphere, as above.
/// @param axis nearly unit, or zero for none
Vec3 disc_centre(std::span<const Vec3> points, const Vec3& axis, int steps);

}  // namespace lmdbench
