// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/snch/hierarchy.h>
#include <lmdbench/snch/node_tests.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// Work of a traversal; each rejection is counted for the first test that rejects.
struct TraversalCounters {
  std::uint64_t node_pairs = 0;
  std::uint64_t rejected_g1 = 0;
  std::uint64_t rejected_g2 = 0;
  std::uint64_t rejected_g3 = 0;
  std::uint64_t leaf_pairs = 0;

  TraversalCounters& operator+=(const TraversalCounters& other) {
    node_pairs += other.node_pairs;
    rejected_g1 += other.rejected_g1;
    rejected_g2 += other.rejected_g2;
    rejected_g3 += other.rejected_g3;
    leaf_pairs += other.leaf_pairs;
    return *this;
  }
};

/// Simultaneous descent through two hierarchies (paper, section 3.2.1): a pair that passes G1, G2
/// and G3 has its children tested against each other, four tests, until both nodes are leaves.
/// Keeps its stack between searches.
class DualTraversal {
 public:
  /// Where a traversal can continue: a pair that passed.
  struct Place {
    WorldNode world_a;
    std::int32_t index_a;
    std::int32_t index_b;
  };

  /// Calls `visit_leaves(triangle_moving, triangle_fixed)` for each leaf pair that passes.
  template <DirectionTest TEST, class LeafVisitor>
  TraversalCounters run(const Hierarchy& moving, const Hierarchy& fixed, const RigidTransform& X_WM,
                        double cutoff, LeafVisitor&& visit_leaves) {
    TraversalCounters counters;
    if (moving.nodes.empty() || fixed.nodes.empty()) return counters;
    stack_.clear();
    const Hierarchies pair{moving, fixed, X_WM, cutoff};
    offer<TEST>(pair, {WorldNode(moving.nodes[0], X_WM), 0, 0}, counters, visit_leaves, stack_);
    descend<TEST>(pair, counters, visit_leaves);
    return counters;
  }

  /// The first levels of `run`: the places where it continues, in its order, at least `wanted` if
  /// there are so many. For threads: `run_below` of all places together visits what `run` visits.
  template <DirectionTest TEST>
  TraversalCounters split(const Hierarchy& moving, const Hierarchy& fixed, const RigidTransform& X_WM,
                          double cutoff, std::size_t wanted, std::vector<Place>& places) {
    TraversalCounters counters;
    places.clear();
    if (moving.nodes.empty() || fixed.nodes.empty()) return counters;
    const Hierarchies pair{moving, fixed, X_WM, cutoff};
    const auto is_leaf_pair = [&](const Place& place) {
      return moving.nodes[static_cast<std::size_t>(place.index_a)].is_leaf() &&
             fixed.nodes[static_cast<std::size_t>(place.index_b)].is_leaf();
    };
    // A leaf pair is visited when found, other pairs from the last to the first.
    std::vector<Place> next, inner;
    const auto take = [&](const Place& place) {
      const auto leaves = [&](std::int32_t, std::int32_t) {};
      const std::size_t before = inner.size();
      const std::uint64_t leaf_pairs = counters.leaf_pairs;
      offer<TEST>(pair, place, counters, leaves, inner);
      if (inner.size() == before && counters.leaf_pairs > leaf_pairs) next.push_back(place);
    };
    take({WorldNode(moving.nodes[0], X_WM), 0, 0});
    next.insert(next.end(), inner.rbegin(), inner.rend());
    for (bool deeper = true; deeper && next.size() < wanted;) {
      places.swap(next);
      next.clear();
      deeper = false;
      for (const Place& place : places) {
        if (is_leaf_pair(place)) {
          next.push_back(place);
          continue;
        }
        deeper = true;
        inner.clear();
        for_each_child(pair, place, take);
        next.insert(next.end(), inner.rbegin(), inner.rend());
      }
    }
    places.swap(next);
    return counters;
  }

  /// The part of `run` below one of `split`'s places.
  template <DirectionTest TEST, class LeafVisitor>
  TraversalCounters run_below(const Place& place, const Hierarchy& moving, const Hierarchy& fixed,
                              const RigidTransform& X_WM, double cutoff, LeafVisitor&& visit_leaves) {
    TraversalCounters counters;
    const HierarchyNode& a = moving.nodes[static_cast<std::size_t>(place.index_a)];
    const HierarchyNode& b = fixed.nodes[static_cast<std::size_t>(place.index_b)];
    if (a.is_leaf() && b.is_leaf()) {
      visit_leaves(a.triangle, b.triangle);
      return counters;
    }
    stack_.assign(1, place);
    descend<TEST>({moving, fixed, X_WM, cutoff}, counters, visit_leaves);
    return counters;
  }

 private:
  struct Hierarchies {
    const Hierarchy& moving;
    const Hierarchy& fixed;
    const RigidTransform& X_WM;
    double cutoff;
  };

  /// Tests a pair: rejected, visited, or kept for descent. Inlined: a call costs a search 2 %.
  template <DirectionTest TEST, class LeafVisitor>
  [[gnu::always_inline]] static inline void offer(const Hierarchies& of, const Place& place,
                                                  TraversalCounters& counters, LeafVisitor&& visit_leaves,
                                                  std::vector<Place>& inner) {
    const HierarchyNode& a = of.moving.nodes[static_cast<std::size_t>(place.index_a)];
    const HierarchyNode& b = of.fixed.nodes[static_cast<std::size_t>(place.index_b)];
    ++counters.node_pairs;
    const NodePair pair(place.world_a, b);
    if (rejected_by_cutoff(pair, of.cutoff)) {
      ++counters.rejected_g1;
    } else if (rejected_by_collinearity(place.world_a, b)) {
      ++counters.rejected_g2;
    } else if (rejected_by_g3<TEST>(place.world_a, b, pair)) {
      ++counters.rejected_g3;
    } else if (a.is_leaf() && b.is_leaf()) {
      ++counters.leaf_pairs;
      visit_leaves(a.triangle, b.triangle);
    } else {
      inner.push_back(place);
    }
  }

  /// Calls take(Place) for the children of a pair, in a fixed order.
  template <class Take>
  static void for_each_child(const Hierarchies& of, const Place& place, Take&& take) {
    const HierarchyNode& a = of.moving.nodes[static_cast<std::size_t>(place.index_a)];
    const HierarchyNode& b = of.fixed.nodes[static_cast<std::size_t>(place.index_b)];
    const auto against_children_of_b = [&](const WorldNode& world_a, std::int32_t index_a) {
      if (b.is_leaf()) {
        take(Place{world_a, index_a, place.index_b});
      } else {
        take(Place{world_a, index_a, b.first_child});
        take(Place{world_a, index_a, b.first_child + 1});
      }
    };
    if (a.is_leaf()) {
      against_children_of_b(place.world_a, place.index_a);
    } else {
      for (std::int32_t child = a.first_child; child <= a.first_child + 1; ++child)
        against_children_of_b(WorldNode(of.moving.nodes[static_cast<std::size_t>(child)], of.X_WM), child);
    }
  }

  template <DirectionTest TEST, class LeafVisitor>
  void descend(const Hierarchies& of, TraversalCounters& counters, LeafVisitor& visit_leaves) {
    while (!stack_.empty()) {
      const Place place = stack_.back();
      stack_.pop_back();
      for_each_child(of, place,
                     [&](const Place& child) { offer<TEST>(of, child, counters, visit_leaves, stack_); });
    }
  }

  std::vector<Place> stack_;
};

}  // namespace lmdbench
