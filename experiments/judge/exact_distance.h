// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

namespace lmdbench::testing {

/// Distance of two triangles in rational arithmetic (CGAL's squared_distance over GMP's rationals), rounded
/// once at the end: 0 exactly when they share a point. It shares no code with the kernels that it judges.
/// @pre finite coordinates
double exact_distance(const Triangle& a, const Triangle& b);

/// Distance of a point from a triangle, likewise.
double exact_distance(const Vec3& point, const Triangle& triangle);

}  // namespace lmdbench::testing
