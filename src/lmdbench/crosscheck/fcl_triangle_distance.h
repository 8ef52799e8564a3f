// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
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

/// What the kernel answers about one pair of triangles within a query of FclCrosscheck, to the
/// last bit: FCL then hands it the triangles in their own frames, with the relative pose, and
/// its errors hang on such roundings.
/// @param moving_M  a triangle of the moving mesh, in that mesh's frame, metres
/// @param fixed_W   a triangle of a fixed mesh, metres
/// @param scale     FclCrosscheck::scale(); 1 for FclScaling::NONE
/// @return distance and points in metres, world frame; point_a on the moving triangle
FclTriangleDistance fcl_triangle_distance(const Triangle& moving_M, const Triangle& fixed_W, const Pose& X_WM,
                                          double scale);

}  // namespace lmdbench
