// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/build/build_wide_hierarchy.h>
#include <lmdbench/methods/certified/keep/wide_lifetime.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>

#include "methods/certified/traverse/wide_samples.h"
#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <support/scenes.h>

#include <cstring>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

/// Makes Highway believe that the processor has one instruction set only.
class OneTarget {
 public:
  explicit OneTarget(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ~OneTarget() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

TEST(WideTargets, EveryInstructionSetFindsTheSamePairsWithTheSameCounters) {
  const WideHierarchy a = build_wide_hierarchy(build_surface(make_blob(1.0, 0.3, 3)));
  const WideHierarchy b = build_wide_hierarchy(build_surface(make_torus(1.0, 0.4, 30, 16)));
  std::mt19937_64 random(1);
  std::set<std::string> names;
  for (int i = 0; i < 20; ++i) {
    const Pose pose{(1.0 + testing::uniform(random)) * testing::random_direction(random),
                    testing::random_rotation(random)};
    const WideQuery query(a, b, RigidTransform(pose), 0.1, 1e-9);
    WideScratch reference;
    WideCounters of_reference;
    find_wide_pairs(a, b, query, WideKernel::SCALAR, reference, of_reference);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      const OneTarget only(target);
      names.emplace(wide_kernel_target());
      WideScratch scratch;
      WideCounters counters;
      find_wide_pairs(a, b, query, WideKernel::VECTOR, scratch, counters);
      SCOPED_TRACE(wide_kernel_target());
      ASSERT_NO_FATAL_FAILURE(testing::expect_same_pairs(scratch, counters, reference, of_reference));

      const WideProbe probe = make_probe(WideChild(a.nodes[0], 0), query.a_in_b);
      MotionForecast motion;
      motion.reset(RigidTransform(), a.radius, 0.2);
      motion.advance(
          RigidTransform(Pose{{0.001, 0.0, 0.0}, Eigen::Quaterniond(1.0, 0.001, 0.0, 0.0).normalized()}),
          1e-12);
      const WideForecast forecast(motion, RigidTransform(pose), 0.1);
      const WideLifetimeTest test{false, {0.001F, 0.0F, 0.0F}, 0xFFu};
      for (const WideNode& node : b.nodes) {
        const WideLifetimes vector = test_lanes_lifetime(node, probe, query.limits, forecast, test);
        const WideLifetimes scalar = test_lanes_lifetime_scalar(node, probe, query.limits, forecast, test);
        ASSERT_NO_FATAL_FAILURE(testing::expect_same_lifetimes(vector, scalar));
      }
    }
  }
  EXPECT_EQ(names.size(), hwy::SupportedAndGeneratedTargets().size());
}

TEST(WideTargets, EveryInstructionSetBuildsTheSameHierarchy) {
  const Surface surface = build_surface(make_blob(1.0, 0.3, 4));
  const WideHierarchy reference = build_wide_hierarchy(surface);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    const OneTarget only(target);
    const WideHierarchy hierarchy = build_wide_hierarchy(surface);
    ASSERT_EQ(hierarchy.nodes.size(), reference.nodes.size());
    EXPECT_EQ(std::memcmp(hierarchy.nodes.data(), reference.nodes.data(),
                          reference.nodes.size() * sizeof(WideNode)),
              0)
        << wide_kernel_target();
  }
}

}  // namespace
}  // namespace lmdbench
