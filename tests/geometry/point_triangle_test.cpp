// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/point_triangle.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace lmdbench {
namespace {

const Triangle RIGHT_TRIANGLE{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

TEST(PointTriangle, ReportsEveryRegion) {
  struct Case {
    Vec3 query, nearest;
    TriangleFeature feature;
  };
  const std::array<Case, 10> cases{
      {{Vec3(1, 1, 2), Vec3(1, 1, 0), TriangleFeature::FACE},
       {Vec3(1, 1, 0), Vec3(1, 1, 0), TriangleFeature::FACE},
       {Vec3(-1, -1, 1), Vec3(0, 0, 0), TriangleFeature::V0},
       {Vec3(6, -1, 0), Vec3(4, 0, 0), TriangleFeature::V1},
       {Vec3(-1, 9, 0), Vec3(0, 4, 0), TriangleFeature::V2},
       {Vec3(2, -3, 1), Vec3(2, 0, 0), TriangleFeature::E0},
       {Vec3(4, 4, 1), Vec3(2, 2, 0), TriangleFeature::E1},
       {Vec3(-3, 2, 1), Vec3(0, 2, 0), TriangleFeature::E2},
       {Vec3(2, 0, 3), Vec3(2, 0, 0), TriangleFeature::E0},    // over an edge: a tie
       {Vec3(4, 0, 7), Vec3(4, 0, 0), TriangleFeature::V1}}};  // over a corner
  for (const Case& test : cases) {
    for (int turn = 0; turn < 3; ++turn) {
      const Triangle turned{RIGHT_TRIANGLE[turn], RIGHT_TRIANGLE[(turn + 1) % 3],
                            RIGHT_TRIANGLE[(turn + 2) % 3]};
      const auto result = point_triangle_distance(test.query, turned);
      EXPECT_EQ(result.point, test.nearest) << test.query.transpose();
      EXPECT_EQ(result.squared_distance, (test.query - test.nearest).squaredNorm());
      const int index = (local_index(test.feature) + 3 - turn) % 3;
      const TriangleFeature expected = is_vertex(test.feature) ? vertex_feature(index)
                                       : is_edge(test.feature) ? edge_feature(index)
                                                               : TriangleFeature::FACE;
      EXPECT_EQ(result.feature, expected) << test.query.transpose() << " turn " << turn;
    }
  }
}

TEST(PointTriangle, StandsNeedles) {
  // The altitude is 1e-10 of the edge. The nearest point is inside, far from every edge in terms of
  // that altitude.
  const Triangle needle{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1e-10, 0)};
  const auto result = point_triangle_distance(Vec3(0.5, 0.25e-10, 1e-6), needle);
  EXPECT_EQ(result.feature, TriangleFeature::FACE);
  EXPECT_NEAR(std::sqrt(result.squared_distance), 1e-6, 1e-20);
}

TEST(PointTriangle, OfEqualCornersIsAPoint) {
  // parry issue 76: two equal corners once gave 0. The issue prints numbers in single precision.
  const Triangle degenerate{Vec3(2.27699995, -7.9000001, 16.3180008),
                            Vec3(-0.569999993, -8.10000038, 16.6070004),
                            Vec3(-0.569999993, -8.10000038, 16.6070004)};
  const auto result = point_triangle_distance(Vec3(1.10000002, -7.9000001, 16.5879993), degenerate);
  EXPECT_NEAR(std::sqrt(result.squared_distance), 0.17147861, 1e-6);
  const Triangle point{Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)};
  EXPECT_EQ(point_triangle_distance(Vec3(1, 1, 3), point).squared_distance, 4.0);
  EXPECT_TRUE(is_vertex(point_triangle_distance(Vec3(1, 1, 3), point).feature));
}

}  // namespace
}  // namespace lmdbench
