// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/methods/certified/decide/touch.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <cmath>

namespace lmdbench {
namespace {

constexpr double MARGIN = 1e-3;

Vec3 unit_normal(const Triangle& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
}

Triangle triangle_about(std::mt19937_64& random, const Vec3& centre) {
  Triangle t;
  for (Vec3& corner : t) corner = centre + testing::uniform(random) * testing::random_direction(random);
  return t;
}

/// Distance of b's extent from a's along the axis; negative where they overlap.
double gap_along(const Vec3& axis, const Triangle& a, const Triangle& b) {
  const auto extent = [&](const Triangle& t) {
    return std::minmax({axis.dot(t[0]), axis.dot(t[1]), axis.dot(t[2])});
  };
  return extent(b).first - extent(a).second;
}

TEST(ClearGap, IsTheGapAlongItsAxisAndNoMoreThanTheDistance) {
  std::mt19937_64 random(31);
  std::size_t clear = 0, apart = 0, together = 0;
  for (int i = 0; i < 20000; ++i) {
    const Triangle a = triangle_about(random, Vec3::Zero());
    const Triangle b =
        triangle_about(random, 2.0 * testing::uniform(random) * testing::random_direction(random));
    const double distance = std::sqrt(triangle_distance(a, b).squared_distance);
    const ClearGap found = clear_gap(a, unit_normal(a), b, unit_normal(b), MARGIN);
    if (distance > 4.0 * MARGIN) ++apart;
    if (distance == 0.0) ++together;
    if (found.gap == 0.0) continue;
    ++clear;
    ASSERT_GT(found.gap, MARGIN);
    ASSERT_LE(found.gap, distance + 1e-12) << i;
    ASSERT_NEAR(found.axis.norm(), 1.0, 1e-12);
    ASSERT_NEAR(gap_along(found.axis, a, b), found.gap, 1e-12) << i << ": from a towards b";
  }
  EXPECT_GT(together, 1000u) << "or the bound is never put to the test";
  // One of the tried axes separates disjoint triangles, by a good part of their distance.
  EXPECT_GT(clear, apart * 9 / 10);
}

TEST(ClearGap, EveryAxisFamilySeparates) {
  const Triangle flat{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const auto moved = [](Triangle t, const Vec3& by) {
    for (Vec3& corner : t) corner += by;
    return t;
  };
  const Triangle above = moved(flat, {0.1, 0.1, 0.5});
  EXPECT_DOUBLE_EQ(clear_gap(flat, Vec3::UnitZ(), above, Vec3::UnitZ(), MARGIN).gap, 0.5);
  EXPECT_DOUBLE_EQ(clear_gap(flat, Vec3::UnitZ(), above, Vec3::Zero(), MARGIN).gap, 0.5) << "a's plane alone";
  EXPECT_DOUBLE_EQ(clear_gap(flat, Vec3::Zero(), above, Vec3::UnitZ(), MARGIN).gap, 0.5) << "b's plane alone";
  EXPECT_DOUBLE_EQ(clear_gap(above, Vec3::UnitZ(), flat, Vec3::UnitZ(), MARGIN).axis.z(), -1.0);
  // Crossed edges: a's along x at height 0, b's along y above; both planes cut the other triangle.
  const Triangle low{Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.2, -2)};
  const Triangle high{Vec3(0, -1, 0.1), Vec3(0, 1, 0.1), Vec3(0.2, 0, 2)};
  const ClearGap crossed = clear_gap(low, unit_normal(low), high, unit_normal(high), MARGIN);
  EXPECT_NEAR(crossed.gap, 0.1, 1e-12);
  EXPECT_NEAR(crossed.axis.z(), 1.0, 1e-12);
  EXPECT_NEAR(clear_gap(high, unit_normal(high), low, unit_normal(low), MARGIN).axis.z(), -1.0, 1e-12);
}

TEST(ClearGap, SmallGapsAreNone) {
  const Triangle flat{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  Triangle above = flat;
  for (Vec3& corner : above) corner.z() += 0.99 * MARGIN;
  EXPECT_EQ(clear_gap(flat, Vec3::UnitZ(), above, Vec3::UnitZ(), MARGIN).gap, 0.0);
  for (Vec3& corner : above) corner.z() += 0.02 * MARGIN;
  EXPECT_GT(clear_gap(flat, Vec3::UnitZ(), above, Vec3::UnitZ(), MARGIN).gap, MARGIN);
}

}  // namespace
}  // namespace lmdbench
