// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/crosscheck/fcl_triangle_distance.h>

#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>

namespace lmdbench {

FclTriangleDistance fcl_triangle_distance(const Triangle& a, const Triangle& b) {
  FclTriangleDistance result;
  result.distance =
      fcl::detail::TriangleDistanced::triDistance(a.data(), b.data(), result.point_a, result.point_b);
  return result;
}

}  // namespace lmdbench
