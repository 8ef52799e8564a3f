// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/motion/sway.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {
namespace {

const Sway RULE{.way_diagonals = 0.5, .turn_rad = 0.4, .period_s = 0.2, .seed = 7};
const Vec3 CENTRE(0.3, -0.1, 0.2);

TEST(Sway, GoesAsFarAsItsRuleSaysAndComesBackAfterAPeriod) {
  const SwayMotion motion(RULE, 0, CENTRE, 2.0);
  double farthest = 0.0, widest = 0.0;
  for (int k = 0; k <= 2000; ++k) {
    const Pose pose = motion.at(1e-4 * k);
    farthest = std::max(farthest, (RigidTransform(pose).point(CENTRE) - CENTRE).norm());
    widest = std::max(widest, 2.0 * std::acos(std::min(1.0, std::abs(pose.rotation.w()))));
  }
  EXPECT_NEAR(farthest, 1.0, 1e-4);  // half of a diagonal of 2 m
  EXPECT_NEAR(widest, 2.0 * std::atan(0.2), 1e-4);
  EXPECT_LT((motion.at(0.05).translation - motion.at(0.25).translation).norm(), 1e-12);
}

TEST(Sway, HasNoJumpOfPositionOrVelocity) {
  const SwayMotion motion(RULE, 3, CENTRE, 2.0);
  constexpr double STEP = 1e-5, FASTEST = 8.0 * 1.0 / 0.2;  // slope of parabolas, 1 m high
  Vec3 last_velocity = (motion.at(STEP).translation - motion.at(0.0).translation) / STEP;
  for (int k = 1; k < 40000; ++k) {
    const Vec3 velocity = (motion.at(STEP * (k + 1)).translation - motion.at(STEP * k).translation) / STEP;
    ASSERT_LT(velocity.norm(), 1.2 * FASTEST);
    ASSERT_LT((velocity - last_velocity).norm(), 0.01 * FASTEST) << "frame " << k;
    last_velocity = velocity;
  }
}

TEST(Sway, EachOfARuleGoesItsOwnWayAndTheSameOneAgain) {
  const auto at = [](std::uint64_t seed, std::uint64_t which) {
    Sway rule = RULE;
    rule.seed = seed;
    return SwayMotion(rule, which, CENTRE, 2.0).at(0.03).translation;
  };
  EXPECT_EQ(at(7, 0), at(7, 0));
  EXPECT_GT((at(7, 0) - at(7, 1)).norm(), 1e-3);
  EXPECT_GT((at(7, 0) - at(8, 0)).norm(), 1e-3);
}

TEST(Sway, ARuleWithoutWayAndTurnStands) {
  const SwayMotion motion({.way_diagonals = 0.0, .turn_rad = 0.0}, 0, CENTRE, 2.0);
  for (const double time : {0.0, 0.1, 0.77}) {
    EXPECT_TRUE(motion.at(time).translation.isZero(0.0));
    EXPECT_EQ(motion.at(time).rotation.w(), 1.0);
  }
}

}  // namespace
}  // namespace lmdbench
