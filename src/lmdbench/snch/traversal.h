// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/snch/hierarchy.h>
#include <lmdbench/snch/node_tests.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

/// What a traversal did; every rejection is counted under the first test that made it.
struct TraversalCounters {
  std::uint64_t node_pairs = 0;
  std::uint64_t rejected_g1 = 0;
  std::uint64_t rejected_g2 = 0;
  std::uint64_t rejected_g3 = 0;
  std::uint64_t leaf_pairs = 0;
};

/// Simultaneous descent through two hierarchies (paper, section 3.2.1): a pair that passes G1, G2
/// and G3 has its children tested against each other, four tests, until both nodes are leaves.
/// Keeps its stack between searches.
class DualTraversal {
 public:
  /// Calls `visit_leaves(triangle_moving, triangle_fixed)` for each leaf pair that passes.
  template <DirectionTest TEST, class LeafVisitor>
  TraversalCounters run(const Hierarchy& moving, const Hierarchy& fixed, const RigidTransform& X_WM,
                        double cutoff, LeafVisitor&& visit_leaves) {
    TraversalCounters counters;
    if (moving.nodes.empty() || fixed.nodes.empty()) return counters;
    stack_.clear();

    const auto offer = [&](const WorldNode& world_a, std::int32_t index_a, std::int32_t index_b) {
      const HierarchyNode& a = moving.nodes[static_cast<std::size_t>(index_a)];
      const HierarchyNode& b = fixed.nodes[static_cast<std::size_t>(index_b)];
      ++counters.node_pairs;
      const NodePair pair(world_a, b);
      if (rejected_by_cutoff(pair, cutoff)) {
        ++counters.rejected_g1;
      } else if (rejected_by_collinearity(world_a, b)) {
        ++counters.rejected_g2;
      } else if (rejected_by_g3<TEST>(world_a, b, pair)) {
        ++counters.rejected_g3;
      } else if (a.is_leaf() && b.is_leaf()) {
        ++counters.leaf_pairs;
        visit_leaves(a.triangle, b.triangle);
      } else {
        stack_.push_back({world_a, index_a, index_b});
      }
    };

    offer(WorldNode(moving.nodes[0], X_WM), 0, 0);
    while (!stack_.empty()) {
      const Entry entry = stack_.back();
      stack_.pop_back();
      const HierarchyNode& a = moving.nodes[static_cast<std::size_t>(entry.index_a)];
      const HierarchyNode& b = fixed.nodes[static_cast<std::size_t>(entry.index_b)];
      const auto offer_against_children_of_b = [&](const WorldNode& world_a, std::int32_t index_a) {
        if (b.is_leaf()) {
          offer(world_a, index_a, entry.index_b);
        } else {
          offer(world_a, index_a, b.first_child);
          offer(world_a, index_a, b.first_child + 1);
        }
      };
      if (a.is_leaf()) {
        offer_against_children_of_b(entry.world_a, entry.index_a);
      } else {
        for (std::int32_t child = a.first_child; child <= a.first_child + 1; ++child)
          offer_against_children_of_b(WorldNode(moving.nodes[static_cast<std::size_t>(child)], X_WM), child);
      }
    }
    return counters;
  }

 private:
  struct Entry {
    WorldNode world_a;
    std::int32_t index_a;
    std::int32_t index_b;
  };
  std::vector<Entry> stack_;
};

}  // namespace lmdbench
