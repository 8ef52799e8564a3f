// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

namespace lmdbench::testing {

/// Distance of two triangles in extended precision (64 bit mantissa, an error near 1e-19 of the
/// coordinates): minimum over 18 corner-edge, 6 corner-face and 9 line-line candidates, 0 where an
/// edge pierces a face. It shares no headers, tolerances or order of work with the kernel, so that
/// both agree only if they are right.
/// @pre the coordinates' sixth powers are in the range of long double
long double brute_force_distance(const Triangle& a, const Triangle& b);

}  // namespace lmdbench::testing
