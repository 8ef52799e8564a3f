// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include <benchmarks/node_test/wide_recording.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace lmdbench::experiments {
namespace {

/// Children, named by node * 8 + lane, from the root to each feature.
class WidePaths {
 public:
  explicit WidePaths(const WideHierarchy& hierarchy) : parent_slot_(hierarchy.nodes.size(), NONE) {
    for (std::uint32_t node = 0; node < hierarchy.nodes.size(); ++node)
      for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
        const WideRef child = WideRef::from_bits(hierarchy.nodes[node].child[lane]);
        const std::uint32_t slot = node * WIDE_WIDTH + lane;
        if (child.is_feature())
          feature_slot_[child.bits()] = slot;
        else if (!child.is_empty())
          parent_slot_[child.node_index()] = slot;
      }
  }

  std::vector<std::uint32_t> to(const FeatureId& feature) const {
    std::vector<std::uint32_t> path;
    const auto found = feature_slot_.find(WideRef::feature(feature).bits());
    if (found == feature_slot_.end()) return path;
    for (std::uint32_t slot = found->second; slot != NONE; slot = parent_slot_[slot / WIDE_WIDTH])
      path.push_back(slot);
    return path;
  }

 private:
  static constexpr std::uint32_t NONE = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> parent_slot_;
  std::unordered_map<std::uint32_t, std::uint32_t> feature_slot_;
};

/// The children above one true LMD.
struct LmdPaths {
  std::vector<std::uint32_t> moving, fixed;

  bool lead_through(std::uint32_t slot_moving, std::uint32_t slot_fixed) const {
    return std::find(moving.begin(), moving.end(), slot_moving) != moving.end() &&
           std::find(fixed.begin(), fixed.end(), slot_fixed) != fixed.end();
  }
};

std::uint32_t lanes_for_touch(const WideNode& node, WideRef probe) {
  std::uint32_t lanes = 0;
  if (probe.is_feature() && !probe.is_face()) return lanes;
  for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
    const WideRef child = WideRef::from_bits(node.child[lane]);
    if (child.is_face() || !child.is_feature()) lanes |= 1u << lane;
  }
  return lanes;
}

/// Descends like find_wide_pairs and records every test.
void record_pose(const WideHierarchy& a, const WideHierarchy& b, const WideQuery& query,
                 const std::vector<LmdPaths>& lmds, std::size_t pose, std::vector<WideTest>& tests) {
  if (!query.possible) return;
  struct Slots {
    std::uint32_t a, b;
  };
  std::vector<Slots> queue = {{0, 0}};
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const Slots slots = queue[next];
    const WideOpening opening = choose_opening(a, b, slots.a, slots.b);
    const std::uint32_t probe_slot = opening.open_a ? slots.b : slots.a;
    const WideNode& home = (opening.open_a ? b : a).nodes[probe_slot / WIDE_WIDTH];
    const WideRef probe_ref = WideRef::from_bits(home.child[probe_slot % WIDE_WIDTH]);
    WideTest test;
    test.node = &(opening.open_a ? a : b).nodes[opening.node];
    test.probe =
        make_probe(WideChild(home, probe_slot % WIDE_WIDTH), opening.open_a ? query.b_in_a : query.a_in_b);
    test.limits = query.limits;
    test.touch_lanes = lanes_for_touch(*test.node, probe_ref);
    test.pose = pose;
    const WideMasks masks = test_lanes_scalar(*test.node, test.probe, test.limits);
    test.used = masks.used;
    for (std::uint32_t lane = 0; lane < WIDE_WIDTH; ++lane) {
      if ((masks.used >> lane & 1u) == 0) continue;
      const std::uint32_t slot = opening.node * WIDE_WIDTH + lane;
      const Slots children = opening.open_a ? Slots{slot, probe_slot} : Slots{probe_slot, slot};
      for (const LmdPaths& lmd : lmds)
        if (lmd.lead_through(children.a, children.b)) test.needed |= 1u << lane;
      const bool survives = ((masks.lmd | (masks.touch & test.touch_lanes)) >> lane & 1u) != 0;
      const bool is_final = probe_ref.is_feature() && WideRef::from_bits(test.node->child[lane]).is_feature();
      if (survives && !is_final) queue.push_back(children);
    }
    tests.push_back(test);
  }
}

}  // namespace

std::vector<WideTest> record_wide_tests(const Setting& setting) {
  const WideHierarchy& moving = setting.scene.moving->prepared<WideHierarchy>();
  const WideHierarchy& fixed = setting.scene.fixed.at(0)->prepared<WideHierarchy>();
  const WidePaths moving_paths(moving), fixed_paths(fixed);
  std::vector<WideTest> tests;
  for (std::size_t i = 0; i < setting.poses.size(); ++i) {
    std::vector<LmdPaths> lmds;
    for (const Lmd& lmd : setting.truth[i])
      lmds.push_back({moving_paths.to(lmd.feature_moving), fixed_paths.to(lmd.feature_fixed)});
    // No touch distance: the poses are apart.
    record_pose(moving, fixed,
                WideQuery(moving, fixed, RigidTransform(setting.poses[i]), setting.scene.cutoff, 0.0), lmds,
                i, tests);
  }
  return tests;
}

}  // namespace lmdbench::experiments
