// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_feature.h>
#include <lmdbench/geometry/types.h>

#include <limits>

namespace lmdbench {

struct PointTriangleDistance {
  double squared_distance = std::numeric_limits<double>::quiet_NaN();
  Vec3 point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< on the triangle
  TriangleFeature feature = TriangleFeature::FACE;  ///< Lowest-dimensional feature of `point`.
};

/// Point of the triangle nearest to `point`. A corner is a bit-copy; permuting the corners changes
/// only the names of the features. Degenerate triangles are segments or points.
PointTriangleDistance point_triangle_distance(const Vec3& point, const Triangle& triangle);

}  // namespace lmdbench
