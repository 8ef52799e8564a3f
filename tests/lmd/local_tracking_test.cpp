// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/local_tracking.h>

#include <gtest/gtest.h>

namespace lmdbench {
namespace {

Lmd pair_at(const Vec3& p, const Vec3& q, bool intersecting) {
  Lmd lmd;
  lmd.point_moving = p;
  lmd.point_fixed = q;
  lmd.distance = (q - p).norm();
  lmd.intersecting = intersecting;
  return lmd;
}

TEST(SetDirection, IsFromMovingToFixed) {
  Lmd lmd = pair_at({1.0, 2.0, 3.0}, {1.0, 2.0, 3.5}, false);
  set_direction(lmd, Vec3::UnitX());
  EXPECT_EQ(lmd.direction, Vec3::UnitZ());
}

/// Decision E12. Also without an intersection, because feature points may coincide.
TEST(SetDirection, AtDistanceZeroIsTheLastValidOne) {
  for (const bool intersecting : {false, true}) {
    Lmd lmd = pair_at({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, intersecting);
    set_direction(lmd, Vec3::UnitX());
    EXPECT_EQ(lmd.direction, Vec3::UnitX()) << intersecting;
  }
}

TEST(IsShorter, IgnoresRoundingOfTheSameTwoPoints) {
  EXPECT_TRUE(is_shorter(0.9, 1.0));
  EXPECT_FALSE(is_shorter(1.0, 1.0));
  EXPECT_FALSE(is_shorter(1.0 - 1e-15, 1.0));
  EXPECT_TRUE(is_shorter(1.0 - 1e-11, 1.0));
}

}  // namespace
}  // namespace lmdbench
