// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/snch/node_tests.h>

#include <benchmarks/node_test/implementation.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lmdbench::experiments {

/// Two nodes of the paper's binary hierarchy.
struct BinaryTest {
  WorldNode moving;
  const HierarchyNode* fixed = nullptr;
  bool needed = false;  ///< A true LMD is below both.
  std::size_t pose = 0;
};

/// For each triangle the nodes from the root to its leaf.
std::vector<std::vector<std::int32_t>> paths_to_triangles(const Hierarchy& hierarchy);

/// G1, G2 and G3 (paper, sections 3.2.1 and 4.1) on the node pairs of DualTraversal in its order.
template <DirectionTest TEST>
class BinaryNodeTest : public NodeTest {
 public:
  explicit BinaryNodeTest(const Setting& setting) : scene_(setting.scene) {
    const Hierarchy& moving = scene_.moving->prepared<Hierarchy>();
    const Hierarchy& fixed = scene_.fixed.at(0)->prepared<Hierarchy>();
    const auto moving_paths = paths_to_triangles(moving), fixed_paths = paths_to_triangles(fixed);
    for (std::size_t i = 0; i < setting.poses.size(); ++i) {
      above_lmds_.clear();
      for (const Lmd& lmd : setting.truth[i])
        above_lmds_.push_back({moving_paths[static_cast<std::size_t>(lmd.triangle_moving)],
                               fixed_paths[static_cast<std::size_t>(lmd.triangle_fixed)]});
      record_pose(moving, fixed, RigidTransform(setting.poses[i]), i);
    }
    survives_.resize(tests_.size());
  }

  void run() override {
    for (std::size_t i = 0; i < tests_.size(); ++i)
      survives_[i] = static_cast<std::uint8_t>(survives(tests_[i].moving, *tests_[i].fixed));
  }
  std::size_t pair_count() const override { return tests_.size(); }
  std::size_t survivor_count() const override {
    return static_cast<std::size_t>(std::count(survives_.begin(), survives_.end(), 1));
  }
  std::size_t needed_count() const override {
    return static_cast<std::size_t>(
        std::count_if(tests_.begin(), tests_.end(), [](const BinaryTest& test) { return test.needed; }));
  }
  std::string objection() override {
    run();
    for (std::size_t i = 0; i < tests_.size(); ++i)
      if (tests_[i].needed && survives_[i] == 0)
        return "test " + std::to_string(i) + " at pose " + std::to_string(tests_[i].pose) +
               ": rejects nodes that hold an LMD";
    return {};
  }

 private:
  struct AboveLmd {
    std::vector<std::int32_t> moving, fixed;
  };

  bool survives(const WorldNode& a, const HierarchyNode& b) const {
    const NodePair pair(a, b);
    return !rejected_by_cutoff(pair, scene_.cutoff) && !rejected_by_collinearity(a, b) &&
           !rejected_by_g3<TEST>(a, b, pair);
  }

  bool is_needed(std::int32_t a, std::int32_t b) const {
    const auto holds = [](const std::vector<std::int32_t>& path, std::int32_t node) {
      return std::find(path.begin(), path.end(), node) != path.end();
    };
    return std::any_of(above_lmds_.begin(), above_lmds_.end(),
                       [&](const AboveLmd& lmd) { return holds(lmd.moving, a) && holds(lmd.fixed, b); });
  }

  void record_pose(const Hierarchy& moving, const Hierarchy& fixed, const RigidTransform& X_WM,
                   std::size_t pose) {
    struct Pair {
      std::int32_t a, b;
    };
    std::vector<Pair> stack;
    const auto offer = [&](std::int32_t index_a, std::int32_t index_b) {
      const HierarchyNode& a = moving.nodes[static_cast<std::size_t>(index_a)];
      const HierarchyNode& b = fixed.nodes[static_cast<std::size_t>(index_b)];
      tests_.push_back({WorldNode(a, X_WM), &b, is_needed(index_a, index_b), pose});
      if (survives(tests_.back().moving, b) && !(a.is_leaf() && b.is_leaf()))
        stack.push_back({index_a, index_b});
    };
    const auto children = [](const Hierarchy& hierarchy, std::int32_t index) {
      const HierarchyNode& node = hierarchy.nodes[static_cast<std::size_t>(index)];
      return node.is_leaf() ? std::vector<std::int32_t>{index}
                            : std::vector<std::int32_t>{node.first_child, node.first_child + 1};
    };
    offer(0, 0);
    while (!stack.empty()) {
      const Pair pair = stack.back();
      stack.pop_back();
      for (const std::int32_t a : children(moving, pair.a))
        for (const std::int32_t b : children(fixed, pair.b)) offer(a, b);
    }
  }

  Scene scene_;
  std::vector<AboveLmd> above_lmds_;  ///< At the recorded pose.
  std::vector<BinaryTest> tests_;
  std::vector<std::uint8_t> survives_;
};

}  // namespace lmdbench::experiments
