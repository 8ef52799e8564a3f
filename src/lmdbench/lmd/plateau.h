// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/lmd/intersections.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>

#include <vector>

namespace lmdbench {

/// A feature pair that meets the first-order condition, with the size of its set of minimisers: 0 a point, 1
/// a segment of that length, 2 a polygon of that area (parallel edges and faces).
struct LocalMinimum {
  Lmd lmd;
  int dimension = 0;
  double measure = 0.0;
  /// Meets the condition to FIRST_ORDER_TOLERANCE; else only to PLATEAU_PIECE_TOLERANCE, and counts as a
  /// piece of a plateau alone.
  bool strict = true;
};

/// Relative difference of two distances below which neighbouring minima are one plateau; their directions may be
/// PARALLEL_TILT apart.
inline constexpr double PLATEAU_TOLERANCE = 1e-9;

/// Distances of one plateau differ by no more than this part of the coordinates for its tilt: two of its points are less
/// than four coordinates apart.
inline constexpr double PLATEAU_SLOPE = 4.5 * PARALLEL_TILT;

/// Leaves one entry a feature pair, sorted by body and features: of the highest dimension the nearest, of
/// those the one with the largest measure; strict if any of them is.
void keep_one_a_feature_pair(std::vector<LocalMinimum>& minima);

/// Makes the LMD set out of local minima: one entry a feature pair, and one entry a plateau. Parallel edges
/// or faces have a whole segment or polygon of minimisers that spreads over many feature pairs; neighbouring
/// pairs of equal distance and direction are joined, and the plateau is represented by the centroid of its
/// pieces of the highest dimension (DEFINITION.md). Where the meshes have a planar tolerance, distances
/// may differ by it (flat_pieces.h). Plateaus without a strict piece are dropped.
///
/// A plateau is named after the flat features it lies on (flat_regions.h), so that its name depends on no
/// piece: on each mesh the face or edge that `FlatRegions::face_at` or `edge_at` gives for the centroid; of
/// several pairs of regions or straight edges the first. Minima that meet in one point, and triangles that
/// intersect, are named after the piece nearest to the centroid. The result depends on the set alone, never
/// on the order of `minima`; it is sorted by `lmd_less`.
///
/// Minima of triangles that intersect are contacts of their own (intersections.h).
/// @param intersections more of those, found without being minima first; they go before minima of equal features
void merge_plateaus(const Scene& scene, const RigidTransform& X_WM, std::vector<LocalMinimum>& minima,
                    std::vector<Intersection>& intersections, LmdSet& lmds);

}  // namespace lmdbench
