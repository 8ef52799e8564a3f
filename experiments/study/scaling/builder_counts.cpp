// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <study/scaling/builder_counts.h>

#include <array>
#include <vector>

namespace lmdbench::scaling {
namespace {

using Slot = std::uint32_t;  // node * WIDE_WIDTH + lane, as in WideScratch

WideRef ref_of(const WideHierarchy& hierarchy, Slot slot) {
  return WideRef::from_bits(hierarchy.nodes[slot / WIDE_WIDTH].child[slot % WIDE_WIDTH]);
}

/// Features below a child that is not opened, or 0.
std::size_t leaf_features(const WideHierarchy& hierarchy, WideRef ref, const CountRule& rule) {
  if (ref.is_feature()) return 1;
  if (rule.leaf_size <= 1) return 0;
  std::size_t count = 0;
  for (const std::uint32_t bits : hierarchy.nodes[ref.node_index()].child) {
    const WideRef child = WideRef::from_bits(bits);
    if (child.is_empty()) continue;
    if (!child.is_feature()) return 0;
    ++count;
  }
  return count <= rule.leaf_size ? count : 0;
}

/// Levels of nodes from a node to the features.
int height(const WideHierarchy& hierarchy, std::uint32_t node, const CountRule& rule) {
  const WideRef first = WideRef::from_bits(hierarchy.nodes[node].child[0]);
  return leaf_features(hierarchy, first, rule) > 0 ? 1 : 1 + height(hierarchy, first.node_index(), rule);
}

/// Levels that are opened with a node: counted from the features, so that full nodes stay full, and the
/// root's may be fewer.
int levels_of(const WideHierarchy& hierarchy, std::uint32_t node, const CountRule& rule) {
  const int rest = height(hierarchy, node, rule) % rule.levels;
  return rest == 0 ? rule.levels : rest;
}

/// Children of a node that is read `levels` at a time.
void collect_children(const WideHierarchy& hierarchy, std::uint32_t node, int levels, const CountRule& rule,
                      std::vector<Slot>& slots) {
  for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
    const Slot slot = node * WIDE_WIDTH + lane;
    const WideRef ref = ref_of(hierarchy, slot);
    if (ref.is_empty()) continue;
    if (levels > 1 && leaf_features(hierarchy, ref, rule) == 0) {
      collect_children(hierarchy, ref.node_index(), levels - 1, rule, slots);
    } else {
      slots.push_back(slot);
    }
  }
}

bool may_touch(WideRef a, WideRef b) {
  return (!a.is_feature() || a.is_face()) && (!b.is_feature() || b.is_face());
}

}  // namespace

TraversalCounts count_traversal(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                                const CountRule& rule) {
  TraversalCounts counts;
  if (!query.possible) return counts;
  std::vector<std::array<Slot, 2>> open{{0, 0}};
  std::vector<Slot> children;
  while (!open.empty()) {
    const auto [slot_a, slot_b] = open.back();
    open.pop_back();
    const WideRef ref_a = ref_of(a, slot_a), ref_b = ref_of(b, slot_b);
    const std::size_t leaf_a = leaf_features(a, ref_a, rule), leaf_b = leaf_features(b, ref_b, rule);
    if (leaf_a > 0 && leaf_b > 0) {
      counts.feature_pairs += leaf_a * leaf_b;
      continue;
    }
    const WideNode& home_a = a.nodes[slot_a / WIDE_WIDTH];
    const WideNode& home_b = b.nodes[slot_b / WIDE_WIDTH];
    const bool open_a = leaf_b > 0 || (leaf_a == 0 && opening_gain(home_a, slot_a % WIDE_WIDTH) >
                                                          opening_gain(home_b, slot_b % WIDE_WIDTH));
    const WideProbe probe = open_a ? make_probe(WideChild(home_b, slot_b % WIDE_WIDTH), query.b_in_a)
                                   : make_probe(WideChild(home_a, slot_a % WIDE_WIDTH), query.a_in_b);
    const WideHierarchy& opened = open_a ? a : b;
    children.clear();
    const std::uint32_t node = (open_a ? ref_a : ref_b).node_index();
    collect_children(opened, node, levels_of(opened, node, rule), rule, children);
    ++counts.tests;
    counts.lanes += children.size();
    for (const Slot child : children) {
      const WideMasks masks = test_lanes_vector(opened.nodes[child / WIDE_WIDTH], probe, query.limits);
      const WideRef ref = ref_of(opened, child);
      const std::uint32_t touch = may_touch(ref, open_a ? ref_b : ref_a) ? masks.touch : 0u;
      if (((masks.lmd | touch) >> child % WIDE_WIDTH & 1u) == 0) continue;
      open.push_back(open_a ? std::array{child, slot_b} : std::array{slot_a, child});
    }
  }
  return counts;
}

std::size_t bytes_with_rule(const WideHierarchy& hierarchy, const CountRule& rule, std::size_t width) {
  std::size_t lanes_per_node = 1;
  for (int level = 0; level < rule.levels; ++level) lanes_per_node *= width;
  const std::size_t node_bytes = lanes_per_node * sizeof(WideNode) / WIDE_WIDTH;
  std::size_t bytes = node_bytes;  // of the node over the root
  std::vector<WideRef> open{ref_of(hierarchy, 0)};
  std::vector<Slot> children;
  while (!open.empty()) {
    const WideRef ref = open.back();
    open.pop_back();
    const std::size_t features = leaf_features(hierarchy, ref, rule);
    if (features > 0) {
      // A lane with one feature holds its number itself.
      if (features > 1) bytes += features * sizeof(std::uint32_t);
      continue;
    }
    bytes += node_bytes;
    children.clear();
    collect_children(hierarchy, ref.node_index(), levels_of(hierarchy, ref.node_index(), rule), rule,
                     children);
    for (const Slot child : children) open.push_back(ref_of(hierarchy, child));
  }
  return bytes;
}

}  // namespace lmdbench::scaling
