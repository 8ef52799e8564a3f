// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/motion/path_facts.h>
#include <lmdbench/motion/rotation_vector.h>

#include <gtest/gtest.h>

#include <cmath>

namespace lmdbench {
namespace {

TEST(PathFacts, CircleTakesItsKnownValues) {
  // Radius 0.1 m at 2 rad/s while turning at 0.5 rad/s about x.
  Path path;
  for (int i = 0; i <= 500; ++i) {
    const double t = i / 250.0;
    path.push_back(
        {t, {0.1 * Vec3(std::cos(2.0 * t), std::sin(2.0 * t), 0.0), rotation_of(Vec3(0.5 * t, 0, 0))}});
  }
  const PathFacts facts = path_facts(PathInterpolator(path), 1000.0);
  EXPECT_EQ(facts.pose_count, 501u);
  EXPECT_EQ(facts.frame_count, 2001u);
  EXPECT_EQ(facts.duration, 2.0);
  EXPECT_NEAR(facts.length, 0.4, 1e-6);
  EXPECT_NEAR(facts.turning, 1.0, 1e-12);
  EXPECT_NEAR(facts.maximum_speed, 0.2, 1e-4);
  EXPECT_NEAR(facts.maximum_acceleration, 0.4, 0.02);
  EXPECT_NEAR(facts.maximum_angular_speed, 0.5, 1e-9);
  EXPECT_NEAR(facts.maximum_angular_acceleration, 0.0, 1e-6);
  EXPECT_NEAR(facts.upper_corner.x(), 0.1, 1e-12);
  EXPECT_NEAR(facts.lower_corner.x(), -0.1, 1e-6);
}

TEST(PathFacts, TooFewFramesLeaveRatesUnset) {
  Path path(1);
  path[0].time = 4.0;
  path[0].pose.translation = Vec3(1, 2, 3);
  const PathFacts facts = path_facts(PathInterpolator(path), 1000.0);
  EXPECT_EQ(facts.frame_count, 1u);
  EXPECT_EQ(facts.start_time, 4.0);
  EXPECT_EQ(facts.duration, 0.0);
  EXPECT_TRUE(std::isnan(facts.maximum_speed));
  EXPECT_TRUE(std::isnan(facts.maximum_acceleration));
  EXPECT_EQ(facts.lower_corner, Vec3(1, 2, 3));
}

}  // namespace
}  // namespace lmdbench
