// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// Relative difference of two distances, and angle of two directions, below which
/// neighbouring minima are one plateau.
inline constexpr double PLATEAU_TOLERANCE = 1e-9;

/// Leaves one entry a feature pair, sorted by body and features: the nearest, of those the one with the
/// largest measure; strict if any of them is.
void keep_one_a_feature_pair(std::vector<LocalMinimum>& minima);

/// Makes the LMD set out of local minima: one entry a feature pair, and one entry a plateau. Parallel edges
/// or faces have a whole segment or polygon of minimisers that spreads over many feature pairs; neighbouring
/// pairs of equal distance and direction are joined, and the plateau is represented by the centroid of its
/// pieces of the highest dimension, on the features of the piece nearest to it (DEFINITION.md). Plateaus
/// without a strict piece are dropped. The result depends on the set alone, never on the order of `minima`;
/// it is sorted by `lmd_less`.
void merge_plateaus(const Scene& scene, std::vector<LocalMinimum>& minima, LmdSet& lmds);

}  // namespace lmdbench
