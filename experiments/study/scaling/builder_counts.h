// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/hierarchy/wide_hierarchy.h>
#include <lmdbench/methods/certified/hierarchy/wide_traversal.h>

#include <cstddef>
#include <cstdint>

namespace lmdbench::scaling {

/// How a hierarchy is read, to count what other layouts would cost.
struct CountRule {
  /// Levels that are opened together: the children of a node are then its children's children, so a tree of
  /// width 4 is one of width 16.
  int levels = 1;
  /// Nodes over at most this many features, and nothing else, are not opened: their features are paired
  /// untested, as if a lane held them all.
  std::size_t leaf_size = 1;
};

struct TraversalCounts {
  std::uint64_t tests = 0;          ///< Tests of one child against all of a node's.
  std::uint64_t lanes = 0;          ///< Children tested.
  std::uint64_t feature_pairs = 0;  ///< Left for the closed-form test.
};

/// Walks as find_wide_pairs does and counts; with the default rule its counts.
TraversalCounts count_traversal(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                                const CountRule& rule);

/// Memory of the hierarchy in a layout that fits the rule.
/// @param width children of the hierarchy's own nodes
std::size_t bytes_with_rule(const WideHierarchy& hierarchy, const CountRule& rule, std::size_t width);

}  // namespace lmdbench::scaling
