// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/types.h>

#include <span>
#include <string>

namespace lmdbench {

/// triangle_distance(a[i], b[i]) for every i, several pairs at a time in the widest vectors that the
/// processor has (chosen at run time; the same bits on every processor). Distances and points agree
/// with triangle_distance to 1e-12 of the largest coordinate; features, flags and minimiser sets are
/// equal. The order of corners and arguments may change the last bits of a point here, where
/// triangle_distance gives the same bits.
/// @pre a.size() == b.size() == results.size()
void triangle_distance_batch(std::span<const Triangle> a, std::span<const Triangle> b,
                             std::span<TrianglePairDistance> results);

/// How often the stages of the batch decide: what the vectors leave to the next stage costs time.
struct TriangleBatchStages {
  std::size_t first_step = 0;      ///< proved by a corner or an edge step from the nearest corners
  std::size_t all_candidates = 0;  ///< proved by examining all feature pairs in vectors
  std::size_t crossing = 0;        ///< found to cross clearly, in vectors
  std::size_t scalar = 0;          ///< left to triangle_distance: touching, parallel and thin features
};

/// As above, and counts.
TriangleBatchStages triangle_distance_batch_stages(std::span<const Triangle> a, std::span<const Triangle> b,
                                                   std::span<TrianglePairDistance> results);

/// Name of the instruction set that this processor uses, for provenance.
std::string triangle_distance_batch_target();

}  // namespace lmdbench
