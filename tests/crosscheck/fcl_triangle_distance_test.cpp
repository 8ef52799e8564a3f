// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/crosscheck/fcl_crosscheck.h>

#include <gtest/gtest.h>

#include <cmath>

namespace lmdbench {
namespace {

/// A triangle in the plane z = 0; `standing_triangle` has its first corner over that one's inside.
Triangle floor_triangle(double size) {
  return {size * Vec3(-1, -1, 0), size * Vec3(1, -1, 0), size * Vec3(0, 1, 0)};
}
Triangle standing_triangle(double size, double height) {
  return {size * Vec3(0, 0, height), size * Vec3(1, 0, 2), size * Vec3(0, 1, 2)};
}

TEST(FclTriangleDistance, IsRightOnTrianglesOfUnitSize) {
  const FclTriangleDistance result = fcl_triangle_distance(floor_triangle(1.0), standing_triangle(1.0, 0.25));
  EXPECT_NEAR(result.distance, 0.25, 1e-12);
  EXPECT_NEAR((result.point_a - Vec3::Zero()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((result.point_b - Vec3(0, 0, 0.25)).norm(), 0.0, 1e-12);
}

TEST(FclTriangleDistance, TakesTheMovingTriangleInItsOwnFrame) {
  const Pose X_WM{Vec3(0.0, 0.0, 0.25), Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vec3::UnitZ()))};
  for (const double scale : {1.0, 3.0}) {
    const FclTriangleDistance result =
        fcl_triangle_distance(standing_triangle(1.0, 0.0), floor_triangle(1.0), X_WM, scale);
    EXPECT_NEAR(result.distance, 0.25, 1e-12);
    EXPECT_NEAR((result.point_a - Vec3(0, 0, 0.25)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(result.point_b.norm(), 0.0, 1e-12);
  }
}

TEST(FclTriangleDistance, IsWrongOnSmallTriangles) {
  constexpr double SIZE = 5e-5;
  const FclTriangleDistance result =
      fcl_triangle_distance(floor_triangle(SIZE), standing_triangle(SIZE, 0.25));
  EXPECT_GT(std::abs(result.distance - 0.25 * SIZE), 0.1 * SIZE)
      << "FCL's kernel no longer skips faces of small triangles: the warning in the header may go";
}

}  // namespace
}  // namespace lmdbench
