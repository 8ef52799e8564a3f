// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/drivers/direction_memory.h>

#include <gtest/gtest.h>

namespace lmdbench {
namespace {

constexpr double CUTOFF = 0.1;

Lmd separated(std::int32_t vertex, const Vec3& at, const Vec3& direction) {
  Lmd lmd;
  lmd.feature_moving = {FeatureKind::VERTEX, vertex};
  lmd.feature_fixed = {FeatureKind::FACE, 0};
  lmd.distance = 0.01;
  lmd.direction = direction;
  lmd.point_fixed = at;
  lmd.point_moving = at - 0.01 * direction;
  return lmd;
}

Lmd touching(std::int32_t vertex, const Vec3& at) {
  Lmd lmd = separated(vertex, at, Vec3::UnitX());
  lmd.distance = 0.0;
  lmd.direction.setConstant(std::numeric_limits<double>::quiet_NaN());
  lmd.point_moving = at;
  lmd.intersecting = true;
  return lmd;
}

TEST(DirectionMemory, SamePairKeepsItsLastDirectionForAsLongAsItTouches) {
  DirectionMemory memory(CUTOFF);
  LmdSet first{separated(1, Vec3(0, 0, 0), Vec3::UnitY()), separated(2, Vec3(0.001, 0, 0), Vec3::UnitZ())};
  EXPECT_EQ(memory.complete(first), 0);
  for (int frame = 0; frame < 3; ++frame) {
    LmdSet next{touching(1, Vec3(0.001, 0, 0))};  // nearer to where LMD 2 was, but it is LMD 1
    EXPECT_EQ(memory.complete(next), 1);
    EXPECT_EQ(next[0].direction, Vec3(Vec3::UnitY()));
  }
}

TEST(DirectionMemory, AnotherPairBorrowsFromTheNearestOfTheFrameBefore) {
  DirectionMemory memory(CUTOFF);
  LmdSet first{separated(1, Vec3(0, 0, 0), Vec3::UnitY()), separated(2, Vec3(0.05, 0, 0), Vec3::UnitZ())};
  memory.complete(first);
  LmdSet next{touching(7, Vec3(0.02, 0, 0)), touching(8, Vec3(1, 0, 0))};
  EXPECT_EQ(memory.complete(next), 2);
  EXPECT_EQ(next[0].direction, Vec3(Vec3::UnitY()));
  EXPECT_EQ(next[1].direction, Vec3(Vec3::UnitZ())) << "long faces cross far from where they met first";
}

TEST(DirectionMemory, AnOlderFrameLendsWithinReachOfTheCutoff) {
  DirectionMemory memory(CUTOFF);
  LmdSet first{separated(1, Vec3(0, 0, 0), Vec3::UnitY())};
  memory.complete(first);
  LmdSet none;
  memory.complete(none);
  LmdSet next{touching(7, Vec3(0.09, 0, 0)), touching(8, Vec3(0.11, 0, 0)), touching(1, Vec3(0.11, 0, 0))};
  memory.complete(next);
  EXPECT_EQ(next[0].direction, Vec3(Vec3::UnitY()));
  EXPECT_TRUE(next[1].direction.hasNaN()) << "beyond the cutoff";
  EXPECT_TRUE(next[2].direction.hasNaN()) << "also of its own pair of features";
}

TEST(DirectionMemory, OtherBodiesLendNothing) {
  DirectionMemory memory(CUTOFF);
  LmdSet first{separated(1, Vec3(0, 0, 0), Vec3::UnitY())};
  memory.complete(first);
  LmdSet next{touching(1, Vec3(0, 0, 0))};
  next[0].fixed_body = 1;
  memory.complete(next);
  EXPECT_TRUE(next[0].direction.hasNaN());
}

TEST(DirectionMemory, WhatRestsInTouchHasADirectionOfItsOwn) {
  DirectionMemory memory(CUTOFF);
  LmdSet rest{separated(1, Vec3::Zero(), Vec3::UnitY())};
  rest[0].distance = 0.0;
  EXPECT_EQ(memory.complete(rest), 0);
  EXPECT_EQ(rest[0].direction, Vec3(Vec3::UnitY()));
  // A tracking method keeps the direction of a pair that intersects since: it is an older one.
  LmdSet kept{touching(1, Vec3::Zero())};
  kept[0].direction = Vec3::UnitZ();
  EXPECT_EQ(memory.complete(kept), 1);
}

TEST(DirectionMemory, StartInContactHasNoDirection) {
  DirectionMemory memory(CUTOFF);
  LmdSet start{touching(1, Vec3::Zero())};
  EXPECT_EQ(memory.complete(start), 1);
  EXPECT_TRUE(start[0].direction.hasNaN());
}

}  // namespace
}  // namespace lmdbench
