// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/lmd.h>

#include <vector>

namespace lmdbench {

/// A critical pair of the distance between two solids (DEFINITION.md, "Critical pairs"): a minimum, which is an LMD, or a saddle.
struct CriticalPair {
  Lmd pair;
  /// +1 for a minimum, -1 for a saddle of first order; where several pairs are one place (a face on a face) the sum of their indices,
  /// which of a place that is just being born may be 0.
  int index = 1;
  bool is_minimum = true;
  /// False for an LMD on a border or where more than two triangles meet: no index is known there, and `index` is 1.
  bool has_index = true;
  /// Whether laws that share a force among minima give it a share: nothing round it is nearer and its index is 1 or more at the pose at
  /// which indices are taken (critical_index.h). The same as `is_minimum` but within some 1e-9 of a birth.
  bool is_basin = true;
};

/// All critical pairs of a pose up to the cutoff, sorted by `lmd_less` of their pairs. Those that are minima are the LMD set, bit for bit.
using CriticalSet = std::vector<CriticalPair>;

/// The minima alone.
LmdSet minima_of(const CriticalSet& set);

/// Sum of all indices. Of disjoint solids and without a cutoff the product of their Euler characteristics, each half of its surface's.
int sum_of_indices(const CriticalSet& set);

void sort_critical(CriticalSet& set);

}  // namespace lmdbench
