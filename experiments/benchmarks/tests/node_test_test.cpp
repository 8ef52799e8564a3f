// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/traverse/wide_traversal.h>
#include <lmdbench/snch/traversal.h>

#include <benchmarks/node_test/wide_recording.h>
#include <gtest/gtest.h>
#include <support/tests/shapes_setting.h>

namespace lmdbench::experiments {
namespace {

TEST(NodeTests, RejectNothingThatIsNeeded) {
  const Setting setting = shapes_setting(0.3, 4);
  for (const NodeTestImplementation& implementation : node_test_implementations()) {
    const auto test = implementation.make(setting);
    EXPECT_EQ(test->objection(), "") << implementation.name;
    EXPECT_GT(test->needed_count(), 0U) << implementation.name;
    EXPECT_GE(test->survivor_count(), test->needed_count()) << implementation.name;
    EXPECT_LT(test->survivor_count(), test->pair_count()) << implementation.name;
  }
}

TEST(NodeTests, ObjectToATestThatRejectsAnLmd) {
  const Setting setting = shapes_setting(0.3, 2);
  const auto reject_all = [](const WideTest& test) {
    WideMasks masks;
    masks.used = test.used;
    return masks;
  };
  const auto careless = wide_node_test("careless", reject_all, reject_all).make(setting);
  EXPECT_NE(careless->objection().find("holds an LMD"), std::string::npos) << careless->objection();
  const auto scalar = [](const WideTest& test) {
    return test_lanes_scalar(*test.node, test.probe, test.limits);
  };
  const auto different = wide_node_test("different", reject_all, scalar).make(setting);
  EXPECT_NE(different->objection().find("scalar form"), std::string::npos) << different->objection();
}

TEST(NodeTests, AreThoseOfTheSearches) {
  const Setting setting = shapes_setting(0.3, 4);
  const Body& moving = *setting.scene.moving;
  const Body& fixed = *setting.scene.fixed[0];
  std::uint64_t wide = 0, binary = 0;
  DualTraversal traversal;
  WideScratch scratch;
  for (const Pose& pose : setting.poses) {
    const RigidTransform X_WM(pose);
    WideCounters counters;
    find_wide_pairs(moving.prepared<WideHierarchy>(), fixed.prepared<WideHierarchy>(),
                    WideQuery(moving.prepared<WideHierarchy>(), fixed.prepared<WideHierarchy>(), X_WM,
                              setting.scene.cutoff, 0.0),
                    WideKernel::VECTOR, scratch, counters);
    wide += counters.node_pairs;
    binary += traversal
                  .run<DirectionTest::RAY>(moving.prepared<Hierarchy>(), fixed.prepared<Hierarchy>(), X_WM,
                                           setting.scene.cutoff, [](std::int32_t, std::int32_t) {})
                  .node_pairs;
  }
  EXPECT_EQ(wide_vector_test().make(setting)->pair_count(), wide);
  EXPECT_EQ(binary_ray_test().make(setting)->pair_count(), binary);
}

}  // namespace
}  // namespace lmdbench::experiments
