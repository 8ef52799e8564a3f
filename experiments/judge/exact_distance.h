// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

namespace lmdbench::testing {

/// Distance of two triangles in rational arithmetic (CGAL's squared_distance over GMP's rationals),
/// rounded once at the end; 0 exactly when they share a point. Shares no code with the kernels.
/// @pre finite coordinates
double exact_distance(const Triangle& a, const Triangle& b);

/// The same for a point and a triangle.
double exact_distance(const Vec3& point, const Triangle& triangle);

}  // namespace lmdbench::testing
