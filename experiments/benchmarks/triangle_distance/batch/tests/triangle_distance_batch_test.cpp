// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/every_family.h"
#include <benchmarks/triangle_distance/batch/triangle_distance_batch.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using testing::Random;
using testing::TrianglePair;

/// Published agreement of batch and scalar kernel, relative to the largest coordinate.
constexpr double AGREEMENT = 1e-12;

struct Pairs {
  std::vector<Triangle> a, b;
  std::vector<TrianglePairDistance> results;

  Pairs(const testing::TriangleFamily& family, std::uint64_t seed, std::size_t count) : results(count) {
    Random random(seed);
    for (std::size_t i = 0; i < count; ++i) {
      const TrianglePair pair = family.generate(random);
      a.push_back(pair.a);
      b.push_back(pair.b);
    }
  }
};

class TriangleBatch : public ::testing::TestWithParam<testing::TriangleFamily> {};

TEST_P(TriangleBatch, AgreesWithTheScalarKernel) {
  Pairs pairs(GetParam(), 301, 10000);
  triangle_distance_batch(pairs.a, pairs.b, pairs.results);
  for (std::size_t i = 0; i < pairs.a.size(); ++i) {
    const TrianglePairDistance scalar = triangle_distance(pairs.a[i], pairs.b[i]);
    const TrianglePairDistance& batch = pairs.results[i];
    const double bound = AGREEMENT * testing::magnitude({pairs.a[i], pairs.b[i]});
    ASSERT_NEAR(std::sqrt(batch.squared_distance), std::sqrt(scalar.squared_distance), bound) << "pair " << i;
    ASSERT_LE((batch.point_a - scalar.point_a).norm(), bound) << "pair " << i;
    ASSERT_LE((batch.point_b - scalar.point_b).norm(), bound) << "pair " << i;
    ASSERT_EQ(batch.feature_a, scalar.feature_a) << "pair " << i;
    ASSERT_EQ(batch.feature_b, scalar.feature_b) << "pair " << i;
    ASSERT_EQ(batch.intersecting, scalar.intersecting) << "pair " << i;
    ASSERT_EQ(batch.minimiser_dimension, scalar.minimiser_dimension) << "pair " << i;
    ASSERT_EQ(batch.squared_distance, (batch.point_a - batch.point_b).squaredNorm()) << "pair " << i;
    if (is_vertex(batch.feature_a) && !batch.intersecting) {
      ASSERT_EQ(batch.point_a, pairs.a[i][local_index(batch.feature_a)]) << "pair " << i;
    }
  }
}

TEST_P(TriangleBatch, GivesTheSameBitsInEveryInstructionSet) {
  Pairs pairs(GetParam(), 302, 1003);
  triangle_distance_batch(pairs.a, pairs.b, pairs.results);
  const std::vector<TrianglePairDistance> best = pairs.results;
  int sets = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    triangle_distance_batch(pairs.a, pairs.b, pairs.results);
    ++sets;
    for (std::size_t i = 0; i < best.size(); ++i) {
      ASSERT_EQ(best[i].point_a, pairs.results[i].point_a)
          << triangle_distance_batch_target() << " pair " << i;
      ASSERT_EQ(best[i].point_b, pairs.results[i].point_b)
          << triangle_distance_batch_target() << " pair " << i;
      ASSERT_EQ(best[i].feature_a, pairs.results[i].feature_a) << triangle_distance_batch_target();
      ASSERT_EQ(best[i].minimiser_measure, pairs.results[i].minimiser_measure);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_GE(sets, 1);
}

INSTANTIATE_TEST_SUITE_P(All, TriangleBatch, testing::every_family(), testing::family_test_name);

TEST(TriangleDistanceBatch, TakesEveryCount) {
  for (std::size_t count = 0; count < 40; ++count) {
    Pairs pairs(testing::triangle_families()[0], count, count);
    const TriangleBatchStages stages = triangle_distance_batch_stages(pairs.a, pairs.b, pairs.results);
    EXPECT_EQ(stages.first_step + stages.all_candidates + stages.crossing + stages.scalar, count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(pairs.results[i].squared_distance,
                  triangle_distance(pairs.a[i], pairs.b[i]).squared_distance, 1e-12);
    }
  }
}

TEST(TriangleDistanceBatch, LeavesGeneralPairsToVectors) {
  // What the scalar kernel gets costs ten times as much; a margin too wide would
  // show here, not in any result.
  Pairs pairs(testing::triangle_families()[0], 303, 10000);
  const TriangleBatchStages stages = triangle_distance_batch_stages(pairs.a, pairs.b, pairs.results);
  EXPECT_GT(stages.first_step, 3000U);
  EXPECT_GT(stages.crossing, 2000U);
  EXPECT_LT(stages.scalar, 100U);
}

TEST(TriangleDistanceBatch, HandsOnWhatIsNotFinite) {
  Pairs pairs(testing::triangle_families()[0], 304, 17);
  pairs.a[3][1][2] = std::nan("");
  pairs.b[9][0][0] = HUGE_VAL;
  triangle_distance_batch(pairs.a, pairs.b, pairs.results);
  for (std::size_t i = 0; i < pairs.results.size(); ++i) {
    EXPECT_EQ(std::isnan(pairs.results[i].squared_distance), i == 3 || i == 9) << i;
  }
}

}  // namespace
}  // namespace lmdbench
