// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_feature.h>
#include <lmdbench/geometry/types.h>

#include <limits>

namespace lmdbench {

/// Closest points of two triangles.
///
/// Invariant: `squared_distance == (point_a - point_b).squaredNorm()`, and both points are feasible (each
/// lies on its triangle up to rounding). Where a whole segment or polygon of pairs attains the minimum
/// (parallel edges or faces) the points are the centroid of that set, `minimiser_dimension` is 1 or 2 and
/// `minimiser_measure` its length or area; else the dimension is 0 and the measure 0.
struct TrianglePairDistance {
  double squared_distance = std::numeric_limits<double>::quiet_NaN();
  Vec3 point_a = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 point_b = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  TriangleFeature feature_a = TriangleFeature::FACE;  ///< Lowest-dimensional part of a that carries point_a.
  TriangleFeature feature_b = TriangleFeature::FACE;  ///< Lowest-dimensional part of b that carries point_b.
  bool intersecting = false;                          ///< The triangles share a point; the distance is 0.
  int minimiser_dimension = 0;
  double minimiser_measure = 0.0;
};

/// Exact-form distance of two triangles given in one frame: every candidate is a feasible point pair (6
/// vertex-face and 9 edge-edge), the least one wins; an intersection gate answers 0 where the triangles share
/// a point. All tolerances are relative to the triangles' size; degenerate triangles are segments or points;
/// never NaN for finite input. Swapping the arguments or permuting corners gives the same point pair.
TrianglePairDistance triangle_distance(const Triangle& a, const Triangle& b);

}  // namespace lmdbench
