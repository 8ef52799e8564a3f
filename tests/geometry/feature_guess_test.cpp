// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/triangle_distance_steps.h>

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <triangles/triangle_families.h>

#include <cmath>
#include <limits>
#include <vector>

namespace lmdbench {
namespace {

using kernel::FeatureGuess;
using testing::Random;
using testing::TrianglePair;

const Triangle FLAT{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

FeatureGuess guess(const Triangle& a, const Triangle& b) {
  return kernel::guess_features(a, b, 0.25);
}

TEST(FeatureGuess, FindsACornerOverAFace) {
  const Triangle tip{Vec3(1, 1, 3), Vec3(0, 1, 5), Vec3(1, 2, 0.5)};
  for (int order = 0; order < 72; ++order) {
    const TrianglePair pair = testing::reordered({FLAT, tip}, order);
    const FeatureGuess found = guess(pair.a, pair.b);
    ASSERT_TRUE(found.exists) << order;
    const auto& [corner, face] =
        order < 36 ? std::pair(found.on_b, found.on_a) : std::pair(found.on_a, found.on_b);
    ASSERT_EQ(corner.count, 1) << order;
    ASSERT_EQ(face.count, 3) << order;
    EXPECT_EQ((order < 36 ? pair.b : pair.a)[corner.corner[0]], tip[2]) << order;
  }
}

TEST(FeatureGuess, FindsAnEdgePair) {
  // The edge of b runs across that of FLAT from (0, 0, 0) to (4, 0, 0), one unit below.
  const Triangle across{Vec3(2, -3, -1), Vec3(2, 3, -1), Vec3(2, 0, -6)};
  for (int order = 0; order < 36; ++order) {
    const TrianglePair pair =
        testing::reordered({Triangle{FLAT[0], FLAT[1], Vec3(2, 0.1, 5)}, across}, order);
    const FeatureGuess found = guess(pair.a, pair.b);
    ASSERT_TRUE(found.exists) << order;
    ASSERT_EQ(found.on_a.count, 2) << order;
    ASSERT_EQ(found.on_b.count, 2) << order;
    EXPECT_EQ(pair.a[found.on_a.corner[0]][2] + pair.a[found.on_a.corner[1]][2], 0.0) << order;
    EXPECT_EQ(pair.b[found.on_b.corner[0]][2] + pair.b[found.on_b.corner[1]][2], -2.0) << order;
  }
}

TEST(FeatureGuess, FindsTwoCorners) {
  const Triangle away{Vec3(7, -1, 1), Vec3(12, 0, 2), Vec3(12, -5, 0)};
  const FeatureGuess found = guess(FLAT, away);
  ASSERT_TRUE(found.exists);
  EXPECT_EQ(found.on_a.feature(), TriangleFeature::V1);
  EXPECT_EQ(found.on_b.feature(), TriangleFeature::V0);
}

TEST(FeatureGuess, SaysNothingOfTrianglesThatCross) {
  const Triangle through{Vec3(1, 1, -2), Vec3(1, 1.5, 2), Vec3(9, 9, 2)};
  EXPECT_FALSE(guess(FLAT, through).exists);
  EXPECT_FALSE(guess(through, FLAT).exists);
}

TEST(FeatureGuess, TakesWhatIsNotFinite) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, std::numeric_limits<double>::max()}) {
    Triangle t = FLAT;
    t[1][2] = bad;
    for (const FeatureGuess& found : {guess(t, FLAT), guess(FLAT, t), guess(t, t)}) {
      EXPECT_TRUE(!found.exists || (found.on_a.count >= 1 && found.on_a.count <= 3 && found.on_b.count >= 1 &&
                                    found.on_b.count <= 3));
    }
  }
}

TEST(FeatureGuess, LeadsToTheProofOfNearlyEveryDisjointPair) {
  // A pair without a proof costs several times as much. Bad guesses change only this count.
  for (const int family : {0, 1, 2}) {
    Random random(501);
    int disjoint = 0, proved = 0;
    for (int i = 0; i < 10000; ++i) {
      const TrianglePair pair = testing::triangle_families()[family].generate(random);
      TrianglePairDistance result;
      const bool is_proved =
          kernel::prove_by_features(pair.a, pair.b, coincidence_length(testing::magnitude(pair)), result);
      proved += is_proved;
      disjoint += is_proved || !triangle_distance(pair.a, pair.b).intersecting;
    }
    EXPECT_GT(disjoint, 5000) << testing::triangle_families()[family].name;
    EXPECT_GT(proved, 0.995 * disjoint) << testing::triangle_families()[family].name;
  }
}

TEST(FeatureGuess, DoesNotLetTheInstructionSetDecideABit) {
  std::vector<TrianglePair> pairs;
  Random random(502);
  for (const testing::TriangleFamily& family : testing::triangle_families()) {
    for (int i = 0; i < 200; ++i) pairs.push_back(family.generate(random));
  }
  std::vector<TrianglePairDistance> best;
  for (const TrianglePair& pair : pairs) best.push_back(triangle_distance(pair.a, pair.b));
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const TrianglePairDistance again = triangle_distance(pairs[i].a, pairs[i].b);
      ASSERT_EQ(again.point_a, best[i].point_a) << hwy::TargetName(target) << " pair " << i;
      ASSERT_EQ(again.point_b, best[i].point_b) << hwy::TargetName(target) << " pair " << i;
      ASSERT_EQ(again.feature_a, best[i].feature_a) << hwy::TargetName(target) << " pair " << i;
      ASSERT_EQ(again.feature_b, best[i].feature_b) << hwy::TargetName(target) << " pair " << i;
      ASSERT_EQ(again.minimiser_measure, best[i].minimiser_measure) << hwy::TargetName(target);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace
}  // namespace lmdbench
