// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <array>

namespace lmdbench {

/// Sign of det(b - a, c - a, d - a): +1 when d lies on the side to which the normal of the
/// counter-clockwise triangle abc points, -1 on the other side, 0 exactly when the points are
/// coplanar. Exact: a rounding error bound decides most calls, expansion arithmetic the rest.
/// @pre finite coordinates whose triple products neither overflow nor underflow
int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// orientation_3d(t[0], t[1], t[2], p) of three points at once; exact.
std::array<int, 3> sides_of_plane(const Triangle& t, const Triangle& points);

/// Sign of the area of abc projected along coordinate axis `dropped_axis` (0, 1 or 2); exact.
int orientation_2d(const Vec3& a, const Vec3& b, const Vec3& c, int dropped_axis);

}  // namespace lmdbench
