// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_feature.h>
#include <lmdbench/geometry/types.h>

#include <limits>

namespace lmdbench {

/// Closest points of two triangles.
/// Invariant: `squared_distance == (point_a - point_b).squaredNorm()`, and both points are feasible
/// (each on its triangle up to rounding). A point at a corner is a bit-copy of it. Where all pairs
/// of a segment or polygon attain the minimum (edges or faces parallel to COINCIDENCE_TOLERANCE),
/// the points are the centroid of that set, `minimiser_dimension` is 1 or 2 and `minimiser_measure`
/// its length or area; otherwise both are 0. Intersecting triangles: the set is the one that they
/// share, and both points are its one centroid.
struct TrianglePairDistance {
  double squared_distance = std::numeric_limits<double>::quiet_NaN();
  Vec3 point_a = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 point_b = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  TriangleFeature feature_a = TriangleFeature::FACE;  ///< Lowest-dimensional feature of point_a.
  TriangleFeature feature_b = TriangleFeature::FACE;  ///< Lowest-dimensional feature of point_b.
  bool intersecting = false;                          ///< They share a point; the distance is 0.
  int minimiser_dimension = 0;
  double minimiser_measure = 0.0;
};

/// Distance of two triangles given in one frame; degenerate triangles are segments or points. The
/// error stays below 1e-14 of the largest coordinate (published bound 1e-12; see
/// results/reference/triangle_accuracy.md), and exact predicates decide `intersecting`. All
/// tolerances are relative to the coordinates. Swapping the arguments or permuting corners gives
/// the same points bit for bit, and an edge or corner the same bits from each of its triangles.
/// Never NaN for finite input; all NaN where a coordinate is not finite.
///
/// Most pairs are proved from a guess of the nearest features (triangle_distance_steps.h): about 60
/// ns a few sizes apart, 140 ns face to face. Contact, parallel features and exact ties go through
/// all candidates (same header): 0.3 to 1 us.
TrianglePairDistance triangle_distance(const Triangle& a, const Triangle& b);

}  // namespace lmdbench
