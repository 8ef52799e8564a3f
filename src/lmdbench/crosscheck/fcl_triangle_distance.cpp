// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/crosscheck/fcl_crosscheck.h>

#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>

namespace lmdbench {

FclTriangleDistance fcl_triangle_distance(const Triangle& a, const Triangle& b) {
  FclTriangleDistance result;
  result.distance =
      fcl::detail::TriangleDistanced::triDistance(a.data(), b.data(), result.point_a, result.point_b);
  return result;
}

FclTriangleDistance fcl_triangle_distance(const Triangle& moving_M, const Triangle& fixed_W, const Pose& X_WM,
                                          double scale) {
  const Triangle moving{scale * moving_M[0], scale * moving_M[1], scale * moving_M[2]};
  const Triangle fixed{scale * fixed_W[0], scale * fixed_W[1], scale * fixed_W[2]};
  FclTriangleDistance result;
  // The fixed triangle goes first, as in FclCrosscheck.
  result.distance = fcl::detail::TriangleDistanced::triDistance(
                        fixed.data(), moving.data(), X_WM.rotation.toRotationMatrix(),
                        scale * X_WM.translation, result.point_b, result.point_a) /
                    scale;
  result.point_a /= scale;
  result.point_b /= scale;
  return result;
}

}  // namespace lmdbench
