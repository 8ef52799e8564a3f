// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/geometry/triangle_intersection.h>

#include <gtest/gtest.h>
#include <triangles/triangle_families.h>

#include <cmath>

namespace lmdbench {
namespace {

using testing::Random;
using testing::TrianglePair;

const Triangle GROUND{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

TEST(TrianglesIntersect, TellsTouchingFromOneUnitInTheLastPlaceAway) {
  const double up = std::nextafter(0.0, 1.0) * 0x1p+1000;  // about 5e-23, exact near 0
  const Triangle touching{Vec3(1, 1, 0), Vec3(2, 1, 4), Vec3(1, 2, 5)};
  const Triangle apart{Vec3(1, 1, up), Vec3(2, 1, 4), Vec3(1, 2, 5)};
  const Triangle through{Vec3(1, 1, -up), Vec3(2, 1, 4), Vec3(1, 2, 5)};
  EXPECT_TRUE(triangles_intersect(GROUND, touching));
  EXPECT_FALSE(triangles_intersect(GROUND, apart));
  EXPECT_TRUE(triangles_intersect(GROUND, through));
}

TEST(TrianglesIntersect, KnowsCoplanarTriangles) {
  EXPECT_TRUE(triangles_intersect(GROUND, {Vec3(1, 1, 0), Vec3(1.5, 1, 0), Vec3(1, 1.5, 0)}));
  EXPECT_TRUE(triangles_intersect(GROUND, {Vec3(-9, -9, 0), Vec3(40, -9, 0), Vec3(-9, 40, 0)}));
  EXPECT_TRUE(triangles_intersect(GROUND, {Vec3(4, 0, 0), Vec3(9, 0, 0), Vec3(9, 3, 0)}));
  EXPECT_TRUE(triangles_intersect(GROUND, {Vec3(2, 2, 0), Vec3(9, 2, 0), Vec3(9, 3, 0)}));
  EXPECT_FALSE(triangles_intersect(GROUND, {Vec3(2.0001, 2, 0), Vec3(9, 2, 0), Vec3(9, 3, 0)}));
  EXPECT_FALSE(triangles_intersect(GROUND, {Vec3(-1, -1, 0), Vec3(-3, 4, 0), Vec3(-1, 9, 0)}));
}

TEST(TrianglesIntersect, AgreesWithTheDistanceWhateverTheOrder) {
  Random random(701);
  int crossings = 0;
  for (const testing::TriangleFamily& family : testing::triangle_families()) {
    for (int i = 0; i < 500; ++i) {
      const TrianglePair pair = family.generate(random);
      const double size = testing::magnitude(pair);
      if (size > 1e30 || size < 1e-30) continue;
      const bool intersect = triangles_intersect(pair.a, pair.b);
      crossings += intersect ? 1 : 0;
      ASSERT_EQ(intersect, triangle_distance(pair.a, pair.b).intersecting);
      for (const int order : {5, 33, 50}) {
        const TrianglePair other = testing::reordered(pair, order);
        ASSERT_EQ(triangles_intersect(other.a, other.b), intersect);
      }
    }
  }
  EXPECT_GT(crossings, 1000);
}

}  // namespace
}  // namespace lmdbench
