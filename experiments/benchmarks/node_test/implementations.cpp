// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/traverse/wide_node_test.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>
#include <lmdbench/snch/node_tests.h>

#include <benchmarks/node_test/wide_recording.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lmdbench::experiments {
namespace {

/// Two nodes of the paper's binary hierarchy.
struct BinaryTest {
  WorldNode moving;
  const HierarchyNode* fixed = nullptr;
  bool needed = false;  ///< A true LMD is below both.
  std::size_t pose = 0;
};

/// For each triangle the nodes from the root to its leaf.
std::vector<std::vector<std::int32_t>> paths_to_triangles(const Hierarchy& hierarchy) {
  std::vector<std::vector<std::int32_t>> paths((hierarchy.nodes.size() + 1) / 2);
  std::vector<std::vector<std::int32_t>> stack = {{0}};
  while (!stack.empty()) {
    const std::vector<std::int32_t> path = stack.back();
    stack.pop_back();
    const HierarchyNode& node = hierarchy.nodes[static_cast<std::size_t>(path.back())];
    if (node.is_leaf()) {
      paths.at(static_cast<std::size_t>(node.triangle)) = path;
      continue;
    }
    for (std::int32_t child = node.first_child; child <= node.first_child + 1; ++child) {
      stack.push_back(path);
      stack.back().push_back(child);
    }
  }
  return paths;
}

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

template <DirectionTest TEST>
NodeTestImplementation binary_test(const std::string& name) {
  return {name, [](const Setting& setting) { return std::make_unique<BinaryNodeTest<TEST>>(setting); }};
}

/// The original's dual solution line cone read as a line (decision E4).
NodeTestImplementation binary_line_test() {
  return binary_test<DirectionTest::LINE>("binary-line");
}

/// Eight children lane by lane: plain C++, the reference of the vector form.
NodeTestImplementation wide_scalar_test() {
  const auto test = [](const WideTest& t) { return test_lanes_scalar(*t.node, t.probe, t.limits); };
  return wide_node_test("wide-scalar", test, test);
}

/// Eight children at once, and for how many frames their rejections are valid: the cost of a test
/// that frame coherence keeps. At rest, without a forecast.
NodeTestImplementation wide_lifetime_test() {
  const auto at_rest = [](const WideTest& t) { return WideLifetimeTest{false, {}, t.touch_lanes}; };
  return wide_node_test(
      "wide-lifetime",
      [=](const WideTest& t) { return test_lanes_lifetime(*t.node, t.probe, t.limits, {}, at_rest(t)); },
      [=](const WideTest& t) {
        return test_lanes_lifetime_scalar(*t.node, t.probe, t.limits, {}, at_rest(t));
      });
}

}  // namespace

/// The tests of the improved algorithm, and of the original one by default (decision E4).
NodeTestImplementation binary_ray_test() {
  return binary_test<DirectionTest::RAY>("binary-ray");
}

/// Eight children at once; each call has the run-time dispatch that a search pays once a query.
NodeTestImplementation wide_vector_test() {
  return wide_node_test(
      "wide-vector", [](const WideTest& t) { return test_lanes_vector(*t.node, t.probe, t.limits); },
      [](const WideTest& t) { return test_lanes_scalar(*t.node, t.probe, t.limits); });
}

std::vector<NodeTestImplementation> node_test_implementations() {
  return {binary_ray_test(), binary_line_test(), wide_scalar_test(), wide_vector_test(),
          wide_lifetime_test()};
}

}  // namespace lmdbench::experiments
