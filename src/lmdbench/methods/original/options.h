// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/snch/hierarchy.h>

#include <cstdint>
#include <numbers>

namespace lmdbench {

/// How the original algorithm reads the dual solution-line cone of G3 (decision E4).
enum class LineCone : std::uint8_t {
  ONE_SIDED,  ///< Ray from moving to fixed sphere, equal to G3.a/b (default: favours the original).
  TWO_SIDED   ///< A line: either end may lie in the cone.
};

/// Triangles of L1 for a contact point inside a triangle (paper, Fig. 5 (a), which can be read both
/// ways). With the triangle alone a pair of face centres stays there until the next search.
enum class FaceNeighbourhood : std::uint8_t {
  OWN,             ///< The triangle itself.
  EDGE_NEIGHBOURS  ///< The three across its edges as well.
};

/// Choices of the original algorithm; defaults are the reports'. Named as in experiment files.
struct OriginalOptions {
  /// Decision E5: how far a 7x7 direction may leave its feature's normal set, in degrees; default
  /// 0.3 radian. Of the sweep 0 .. pi on 1,000 grazing poses of two bunnies (recall study) the
  /// value that favours the original: the largest mean F1 after tracking over the cutoffs 0.5, 2
  /// and 5 % of the diagonal, neighbouring features counting.
  double g5_tolerance_deg = 0.3 * 180.0 / std::numbers::pi;
  LineCone line_cone = LineCone::ONE_SIDED;
  FaceNeighbourhood face_neighbourhood = FaceNeighbourhood::OWN;
  /// Of the points that stand for a triangle: 3, 7 (the paper's), 13 or 25; see `feature_points.h`.
  int feature_points = 7;
  LeafCones leaf_cones = LeafCones::ONE_RING;  ///< Decision E1.
  bool merge_duplicates = true;                ///< Decision E13; false: an LMD a triangle pair.
  bool literal_g3 = false;  ///< Ablation of decision E2: keep what the printed inequality keeps.
};

}  // namespace lmdbench
