// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace lmdbench {

/// How the visibility pre-test of the improved algorithm reads the paper (decision E6).
enum class Visibility : std::uint8_t {
  VERTEX_NORMAL,  ///< Project each corner along its vertex normal onto the other plane (default).
  ORTHOGONAL,     ///< Project each corner orthogonally onto the other plane.
  OFF             ///< No pre-test.
};

/// Which LMDs the improved algorithm's tracking drops (decision E7).
enum class Reduction : std::uint8_t {
  PUBLISHED,  ///< Section 4.2.1: the minimum was computed for another LMD.
  LOSS_FREE   ///< Only an LMD that ends on the same feature pair as another one.
};

/// In which order the improved algorithm's tracking takes the LMDs of a set (decision E7): what the published
/// reduction drops depends on it.
enum class TrackingOrder : std::uint8_t {
  NEAREST_FIRST,  ///< By distance, then features (default: loses least).
  TRIANGLE_INDEX  ///< By triangle numbers, which say nothing about the distance.
};

/// How the original algorithm reads the dual solution-line cone of G3 (decision E4).
enum class LineCone : std::uint8_t {
  ONE_SIDED,  ///< A ray from the moving to the fixed sphere, equal to G3.a/b (default: favours the original).
  TWO_SIDED   ///< A line: either end may lie in the cone.
};

/// Free choices of the paper's algorithms; defaults are those of the reports.
struct MethodOptions {
  Visibility visibility = Visibility::VERTEX_NORMAL;
  Reduction reduction = Reduction::PUBLISHED;
  TrackingOrder tracking_order = TrackingOrder::NEAREST_FIRST;
  LineCone line_cone = LineCone::ONE_SIDED;
  /// Decision E5: how far a 7x7 direction may leave its feature's normal set. Of the sweep 0 ..
  /// pi on 1,000 grazing poses of two bunnies the value with the largest mean F1 score after
  /// tracking over the cutoffs 0.5, 2 and 5 % of the diagonal, neighbouring features counting as
  /// found: the one that favours the original.
  double g5_tolerance_rad = 0.3;
  bool literal_g3 = false;  ///< Ablation of decision E2: keep what the printed inequality keeps.
  bool frame_coherence =
      true;  ///< `certified` reuses the last frame's tests; the set is the same either way.
};

}  // namespace lmdbench
