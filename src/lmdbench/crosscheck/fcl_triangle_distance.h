// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>

#include <limits>

namespace lmdbench {

/// What FCL's triangle kernel answers, unchanged.
struct FclTriangleDistance {
  double distance =
      std::numeric_limits<double>::quiet_NaN();  ///< In the triangles' unit; 0 where FCL sees contact.
  Vec3 point_a = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< Arbitrary when distance is 0.
  Vec3 point_b = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< Arbitrary when distance is 0.
};

/// Distance of two triangles by FCL's kernel (fcl::detail::TriangleDistance), called as it is: a peer to
/// compare with, not a reference.
/// @warning Known to be wrong on triangles whose squared doubled area is under 1e-15 and on nearly parallel
/// edges; see fcl_crosscheck.h for the remedy of the first.
FclTriangleDistance fcl_triangle_distance(const Triangle& a, const Triangle& b);

}  // namespace lmdbench
