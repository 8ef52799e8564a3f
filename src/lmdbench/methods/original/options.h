// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/snch/hierarchy.h>

#include <cstdint>
#include <numbers>

namespace lmdbench {

/// How the original algorithm reads the dual solution-line cone of G3 (decision E4).
enum class LineCone : std::uint8_t {
  ONE_SIDED,  ///< A ray from the moving to the fixed sphere, equal to G3.a/b (default: favours the original).
  TWO_SIDED   ///< A line: either end may lie in the cone.
};

/// Which triangles L1 looks at for a contact point inside a triangle (paper, Fig. 5 (a)). The drawing can be read both
/// ways; with the triangle alone a pair of two face centres never leaves its triangles, and only the next search does.
enum class FaceNeighbourhood : std::uint8_t {
  OWN,             ///< The triangle itself.
  EDGE_NEIGHBOURS  ///< The three across its edges as well.
};

/// Free choices of the original algorithm; defaults are those of the reports. Members are called as in
/// experiment files.
struct OriginalOptions {
  /// Decision E5: how far a 7x7 direction may leave its feature's normal set, in degrees; 0.3 radian by
  /// default. Of the sweep 0 .. pi on 1,000 grazing poses of two bunnies (recall study) the value with the
  /// largest mean F1 score after tracking over the cutoffs 0.5, 2 and 5 % of the diagonal, neighbouring
  /// features counting as found: the one that favours the original.
  double g5_tolerance_deg = 0.3 * 180.0 / std::numbers::pi;
  LineCone line_cone = LineCone::ONE_SIDED;
  FaceNeighbourhood face_neighbourhood = FaceNeighbourhood::OWN;
  /// Of the points that stand for a triangle: 3, 7 (the paper's), 13 or 25; see `feature_points.h`.
  int feature_points = 7;
  LeafCones leaf_cones = LeafCones::ONE_RING;  ///< Decision E1.
  bool merge_duplicates = true;  ///< Decision E13; false: as many LMDs as triangle pairs lead to them.
  bool literal_g3 = false;       ///< Ablation of decision E2: keep what the printed inequality keeps.
};

}  // namespace lmdbench
