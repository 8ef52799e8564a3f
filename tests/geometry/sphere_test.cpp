// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/sphere.h>

#include <gtest/gtest.h>
#include <triangles/random_triangles.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

using testing::random_point;

TEST(BoundingSphere, OfNothingAndOfOnePointHasNoRadius) {
  EXPECT_EQ(bounding_sphere({}).radius, 0.0);
  const std::array<Vec3, 3> same{Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)};
  EXPECT_EQ(bounding_sphere(same).radius, 0.0);
  EXPECT_EQ(bounding_sphere(same).centre, Vec3(1, 2, 3));
}

TEST(BoundingSphere, OfAnObtuseTriangleSpansItsLongestEdge) {
  const std::array<Vec3, 3> points{Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0.3, 0.2, 0)};
  EXPECT_NEAR(bounding_sphere(points).radius, 1.0, 1e-12);
}

TEST(BoundingSphere, OfAnEquilateralTriangleIsItsCircumcircle) {
  const std::array<Vec3, 3> points{Vec3(1, 0, 0), Vec3(-0.5, std::sqrt(0.75), 0),
                                   Vec3(-0.5, -std::sqrt(0.75), 0)};
  EXPECT_NEAR(bounding_sphere(points).radius, 1.0, 1e-12);
}

TEST(BoundingSphere, OfACubeIsItsHalfDiagonal) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  const Sphere sphere = bounding_sphere(points);
  EXPECT_NEAR(sphere.radius, std::sqrt(0.75), 1e-12);
  EXPECT_NEAR((sphere.centre - Vec3(0.5, 0.5, 0.5)).norm(), 0.0, 1e-10);
}

TEST(BoundingSphere, HoldsEveryPointAndIsTheSmallest) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 300; ++round) {
    // Points in the unit ball, four of them on its surface and around its centre: the unit ball is
    // the smallest sphere.
    const double scale = std::pow(10.0, round % 13 - 6);
    const Vec3 centre = random_point(random) * scale;
    std::vector<Vec3> points;
    for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)}) {
      points.push_back(centre + corner.normalized() * scale);
    }
    for (int i = 0; i < round; ++i)
      points.push_back(centre + random_point(random) * (scale / std::sqrt(3.0)));
    std::shuffle(points.begin(), points.end(), random);
    const Sphere sphere = bounding_sphere(points);
    for (const Vec3& point : points) ASSERT_LE((point - sphere.centre).norm(), sphere.radius);
    ASSERT_NEAR(sphere.radius / scale, 1.0, 1e-9) << "round " << round;
  }
}

TEST(BoundingSphere, StandsDegenerateSets) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> along(0.0, 1.0);
  for (int round = 0; round < 100; ++round) {
    const Vec3 p = random_point(random);
    const Vec3 d = random_point(random);
    std::vector<Vec3> collinear{p, p + d};
    for (int i = 0; i < 30; ++i) collinear.push_back(p + along(random) * d);
    const Sphere sphere = bounding_sphere(collinear);
    for (const Vec3& point : collinear) ASSERT_LE((point - sphere.centre).norm(), sphere.radius);
    ASSERT_NEAR(sphere.radius, 0.5 * d.norm(), 1e-9);
  }
  // All points are on one sphere: each is a candidate for the support.
  std::vector<Vec3> on_sphere;
  for (int i = 0; i < 500; ++i) on_sphere.push_back(random_point(random).normalized());
  EXPECT_NEAR(bounding_sphere(on_sphere).radius, 1.0, 1e-3);
  EXPECT_LE(bounding_sphere(on_sphere).radius, 1.0 + 1e-12);
}

}  // namespace
}  // namespace lmdbench
