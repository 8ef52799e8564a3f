// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/triangle_intersection.h>

#include <gtest/gtest.h>
#include <triangles/brute_force_distance.h>
#include <triangles/triangle_families.h>

#include <cmath>

namespace lmdbench {
namespace {

using testing::Random;
using testing::TrianglePair;

const Triangle GROUND{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

TEST(TrianglesIntersect, TellsTouchingFromOneUnitInTheLastPlaceAway) {
  const double up = std::nextafter(0.0, 1.0) * 0x1p+1000;  // about 5e-23: exact beside coordinates near 1
  const Triangle touching{Vec3(1, 1, 0), Vec3(2, 1, 4), Vec3(1, 2, 5)};
  const Triangle apart{Vec3(1, 1, up), Vec3(2, 1, 4), Vec3(1, 2, 5)};
  const Triangle through{Vec3(1, 1, -up), Vec3(2, 1, 4), Vec3(1, 2, 5)};
  EXPECT_TRUE(triangles_intersect(GROUND, touching));
  EXPECT_FALSE(triangles_intersect(GROUND, apart));
  EXPECT_TRUE(triangles_intersect(GROUND, through));
}

TEST(TrianglesIntersect, KnowsCoplanarTriangles) {
  EXPECT_TRUE(triangles_intersect(GROUND, {Vec3(1, 1, 0), Vec3(1.5, 1, 0), Vec3(1, 1.5, 0)}));    // inside
  EXPECT_TRUE(triangles_intersect(GROUND, {Vec3(-9, -9, 0), Vec3(40, -9, 0), Vec3(-9, 40, 0)}));  // around
  EXPECT_TRUE(triangles_intersect(GROUND, {Vec3(4, 0, 0), Vec3(9, 0, 0), Vec3(9, 3, 0)}));        // a corner
  EXPECT_TRUE(triangles_intersect(GROUND, {Vec3(2, 2, 0), Vec3(9, 2, 0), Vec3(9, 3, 0)}));  // on an edge
  EXPECT_FALSE(triangles_intersect(GROUND, {Vec3(2.0001, 2, 0), Vec3(9, 2, 0), Vec3(9, 3, 0)}));
  EXPECT_FALSE(triangles_intersect(GROUND, {Vec3(-1, -1, 0), Vec3(-3, 4, 0), Vec3(-1, 9, 0)}));
}

TEST(IntersectionSegment, IsTheSharedPiece) {
  const auto segment = intersection_segment(GROUND, {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(3, -9, 0)});
  ASSERT_TRUE(segment);
  // From the wall's edge over (1, 1) to the floor's edge y = 0, on the line to (3, -9).
  EXPECT_NEAR(((*segment)[0] - Vec3(1, 1, 0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(((*segment)[1] - Vec3(1.2, 0, 0)).norm(), 0.0, 1e-15);
}

TEST(IntersectionSegment, OfACornerThatTouchesIsThatCorner) {
  const auto segment = intersection_segment(GROUND, {Vec3(1, 1, 0), Vec3(2, 1, 4), Vec3(1, 2, 5)});
  ASSERT_TRUE(segment);
  EXPECT_EQ((*segment)[0], Vec3(1, 1, 0));
  EXPECT_EQ((*segment)[1], Vec3(1, 1, 0));
}

TEST(IntersectionSegment, IsEmptyForDisjointCoplanarAndFlatTriangles) {
  EXPECT_FALSE(intersection_segment(GROUND, {Vec3(1, 1, 1), Vec3(2, 1, 4), Vec3(1, 2, 5)}));
  EXPECT_FALSE(intersection_segment(GROUND, GROUND));
  EXPECT_FALSE(intersection_segment(GROUND, {Vec3(1, 1, -1), Vec3(1, 1, 0), Vec3(1, 1, 1)}));
}

TEST(IntersectionSegment, LiesOnBothTrianglesWhateverTheOrder) {
  Random random(701);
  int crossings = 0;
  for (const testing::TriangleFamily& family : testing::triangle_families()) {
    for (int i = 0; i < 500; ++i) {
      const TrianglePair pair = family.generate(random);
      const double size = testing::magnitude(pair);
      if (size > 1e30 || size < 1e-30) continue;
      ASSERT_EQ(triangles_intersect(pair.a, pair.b), triangle_distance(pair.a, pair.b).intersecting);
      const auto segment = intersection_segment(pair.a, pair.b);
      for (const int order : {5, 33, 50}) {
        const TrianglePair other = testing::reordered(pair, order);
        ASSERT_EQ(triangles_intersect(other.a, other.b), triangles_intersect(pair.a, pair.b));
        const auto again = intersection_segment(other.a, other.b);
        ASSERT_EQ(again.has_value(), segment.has_value());
        if (segment) {
          ASSERT_EQ(*again, *segment);
        }
      }
      if (!segment) continue;
      ++crossings;
      for (const Vec3& end : *segment) {
        ASSERT_LE(static_cast<double>(testing::brute_force_distance({end, end, end}, pair.a)), 1e-14 * size);
        ASSERT_LE(static_cast<double>(testing::brute_force_distance({end, end, end}, pair.b)), 1e-14 * size);
      }
    }
  }
  EXPECT_GT(crossings, 1000);
}

}  // namespace
}  // namespace lmdbench
