// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/snch/hierarchy.h>

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

/// Order of LMDs in the improved algorithm's tracking (decision E7): the published reduction drops
/// by it.
enum class TrackingOrder : std::uint8_t {
  NEAREST_FIRST,  ///< By distance, then features (default: loses least).
  TRIANGLE_INDEX  ///< By triangle numbers, which say nothing about the distance.
};

/// Choices of the improved algorithm; defaults are the reports'. Named as in experiment files.
struct ImprovedOptions {
  Visibility visibility = Visibility::VERTEX_NORMAL;
  Reduction reduction = Reduction::PUBLISHED;
  TrackingOrder tracking_order = TrackingOrder::NEAREST_FIRST;
  LeafCones leaf_cones = LeafCones::ONE_RING;  ///< Decision E1.
  bool second_tracking = true;                 ///< Decision E11; false: searches are tracked once.
  bool plain_cache = false;         ///< Ablation: std::unordered_map as result cache; same answers.
  bool literal_g3 = false;          ///< Ablation of decision E2: the printed inequality.
  std::int32_t search_threads = 1;  ///< Of the global search (the paper's future work); same bits.
  bool clamped_sigma = false;       ///< Ablation of decision E3: 90 degrees where spheres overlap.
};

}  // namespace lmdbench
