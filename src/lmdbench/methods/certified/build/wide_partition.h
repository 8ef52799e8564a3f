// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/build/wide_items.h>

#include <cstddef>
#include <vector>

namespace lmdbench {

class ShapeComplex;

/// Sets of features smaller than this are treated by one thread.
inline constexpr std::size_t SMALLEST_PARALLEL_SET = 4096;

/// How the children of a node share a set of features: all but the last get `unit` of them.
struct WideDivision {
  std::size_t unit;      ///< Sets are divided at multiples of this.
  std::size_t children;  ///< At most the width.

  /// The unit is a power of the width: nodes are full but for one path below the root.
  explicit WideDivision(std::size_t size);
};

/// Number of nodes of the tree over a set, this tree's root included; none for a single feature.
std::size_t count_wide_nodes(std::size_t size);

/// Puts the items into the order of the tree: every node's children are consecutive ranges of its
/// own (WideDivision). Sets are divided across the direction in which they spread most, small ones
/// across the turn of it that leaves the halves with the smallest discs and cones: a part that lies
/// askew in its frame gets as good a tree. The feature breaks ties, so that the result depends on
/// the mesh alone.
/// @param origin of the hierarchy
void partition_wide_items(const Surface& surface, const ShapeComplex* shape, const Vec3& origin,
                          std::vector<WideItem>& items);

}  // namespace lmdbench
