// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/methods/certified/certified.h>
#include <lmdbench/methods/certified/traverse/wide_traversal.h>
#include <lmdbench/methods/certified/vector_target.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

constexpr VectorTarget ALL_TARGETS[] = {VectorTarget::BEST, VectorTarget::AVX512, VectorTarget::AVX2,
                                        VectorTarget::SSE4, VectorTarget::SCALAR};

TEST(UseVectorTarget, LastsAsLongAsItLives) {
  const std::string best(wide_kernel_target());
  std::set<std::string> names;
  int available = 0;
  for (const VectorTarget target : ALL_TARGETS) {
    if (!is_available(target)) {
      EXPECT_THROW(UseVectorTarget use(target), EnvironmentError);
      continue;
    }
    ++available;
    {
      const UseVectorTarget use(target);
      if (target != VectorTarget::BEST) names.emplace(wide_kernel_target());
      EXPECT_TRUE(target != VectorTarget::BEST || wide_kernel_target() == best);
      EXPECT_TRUE(target != VectorTarget::SCALAR || wide_kernel_target() == "SCALAR");
    }
    EXPECT_EQ(wide_kernel_target(), best);
  }
  ASSERT_TRUE(is_available(VectorTarget::SCALAR));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(available) - 1) << "without BEST";
}

TEST(UseVectorTarget, FindsTheSameSetsWithTheSameWork) {
  const Scene scene = testing::make_scene(make_blob(1.0, 0.3, 3), make_torus(1.0, 0.4, 30, 16), 0.05);
  std::vector<std::unique_ptr<Certified>> methods;
  for (const VectorTarget target : ALL_TARGETS)
    if (is_available(target))
      methods.push_back(std::make_unique<Certified>(scene, CertifiedOptions{.kernel = target}));
  ASSERT_GE(methods.size(), 2U);
  std::mt19937_64 random(5);
  const Vec3 towards = testing::random_direction(random);
  const Eigen::Quaterniond rotation = testing::random_rotation(random);
  std::size_t lmds = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const Pose pose{(1.6 - 0.012 * frame) * towards, rotation};
    LmdSet expected;
    WorkCounters of_expected;
    methods.front()->search(pose, expected, of_expected);
    lmds += expected.size();
    for (std::size_t i = 1; i < methods.size(); ++i) {
      LmdSet found;
      WorkCounters of_found;
      methods[i]->search(pose, found, of_found);
      EXPECT_EQ(of_found, of_expected) << frame;
      ASSERT_EQ(found.size(), expected.size()) << frame;
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_EQ(found[k].point_moving, expected[k].point_moving) << frame;
        EXPECT_EQ(found[k].point_fixed, expected[k].point_fixed) << frame;
      }
    }
  }
  EXPECT_GT(lmds, 30U);
}

}  // namespace
}  // namespace lmdbench
