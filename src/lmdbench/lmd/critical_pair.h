// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>

#include <vector>

namespace lmdbench {

/// A critical pair of two solids' distance (DEFINITION.md, "Critical pairs"): LMD or saddle.
struct CriticalPair {
  Lmd pair;
  /// +1 for a minimum, -1 for a saddle of first order. Of several pairs at one place the sum: of a
  /// face on a face 1 less the holes of their overlap, and 0 just at a birth.
  int index = 1;
  bool is_minimum = true;
  /// False for an LMD on a border or at more than two triangles; then `index` is 1.
  bool has_index = true;
  /// Whether laws that share a force among minima give it a share: at the pose of indices nothing
  /// round it is nearer and nothing leads down from it. Equals `is_minimum`, except near births.
  bool is_basin = true;
};

/// Critical pairs up to the cutoff, sorted by `lmd_less`. The minima are the LMD set, bit for bit.
using CriticalSet = std::vector<CriticalPair>;

/// The minima alone.
LmdSet minima_of(const CriticalSet& set);

/// Sum of indices: of disjoint solids without cutoff the product of their Euler characteristics.
int sum_of_indices(const CriticalSet& set);

void sort_critical(CriticalSet& set);

}  // namespace lmdbench
