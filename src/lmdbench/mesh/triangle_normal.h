// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <array>
#include <cstddef>

namespace lmdbench {

/// A triangle counts as one without area when |e0 x e1| / (longest side)^2, like a sine, is at or
/// below this. The sides carry half a unit in the last place of rounding, so at this ratio the
/// normal is still right to about 1e-3 radians; below, it is noise.
inline constexpr double ZERO_AREA_TOLERANCE = 1e-12;

/// Cross product whose components carry one rounding error each (Kahan's difference of products). A
/// plain one loses every digit where a and b are nearly parallel.
Vec3 accurate_cross(const Vec3& a, const Vec3& b);

/// Unit normal of a triangle, corners counter-clockwise seen against it; zero for a triangle
/// without area (`ZERO_AREA_TOLERANCE`). Works at every scale: no product over- or underflows.
Vec3 triangle_normal(const Triangle& triangle);

/// Angles at the corners, radians in [0, pi]; 0 where one of the two sides has no length.
std::array<double, 3> corner_angles(const Triangle& triangle);

/// One of them, with the same bits.
double corner_angle(const Triangle& triangle, std::size_t corner);

}  // namespace lmdbench
