// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/crosscheck/fcl_crosscheck.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lmdbench {
namespace {

/// Rounding of scaling, transforming and scaling back; the contract's tolerance is 1e-6.
constexpr double RELATIVE_TOLERANCE = 1e-9;

/// Axis-aligned cube of the given edge length round the origin: 12 triangles.
TriangleMesh cube(double edge) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(0.5 * edge * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

Surface cube_surface(double edge, const Vec3& centre_W = Vec3::Zero()) {
  TriangleMesh mesh = cube(edge);
  for (Vec3& p : mesh.vertices) p += centre_W;
  return build_surface(std::move(mesh));
}

/// A pose in which a cube stands on one corner, `gap` above the top face (z = edge / 2) of an equal
/// cube, over the inside of one of its triangles. The true distance is the gap.
Pose corner_over_face(double edge, double gap) {
  const Vec3 corner = Vec3::Constant(-0.5 * edge);
  const Eigen::Quaterniond rotation = Eigen::Quaterniond::FromTwoVectors(corner, -Vec3::UnitZ());
  const Vec3 lowest_W(0.17 * edge, 0.05 * edge, 0.5 * edge + gap);
  return {lowest_W - rotation * corner, rotation};
}

Pose random_pose(std::mt19937_64& generator, double distance) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond rotation(normal(generator), normal(generator), normal(generator),
                                    normal(generator));
  const Vec3 direction(normal(generator), normal(generator), normal(generator));
  return {distance * direction.normalized(), rotation.normalized()};
}

TEST(FclCrosscheck, FindsACornerOverAFace) {
  const Surface surface = cube_surface(0.02);
  const FclCrosscheck fcl(surface, {&surface});
  const FclResult result = fcl.distance(corner_over_face(0.02, 3e-4));
  EXPECT_TRUE(result.separated);
  EXPECT_NEAR(result.distance, 3e-4, RELATIVE_TOLERANCE * 0.02);
  EXPECT_NEAR((result.point_moving - result.point_fixed).norm(), result.distance, RELATIVE_TOLERANCE * 0.02);
  EXPECT_NEAR((result.point_moving - Vec3(0.17 * 0.02, 0.05 * 0.02, 0.01 + 3e-4)).norm(), 0.0,
              RELATIVE_TOLERANCE * 0.02);
  EXPECT_NEAR(result.point_fixed.z(), 0.01, RELATIVE_TOLERANCE * 0.02);
  EXPECT_EQ(result.fixed_body, 0);
  EXPECT_THAT(result.triangle_fixed, testing::AnyOf(2, 3)) << "triangles of the top face";
  EXPECT_THAT(surface.mesh.triangles.at(static_cast<std::size_t>(result.triangle_moving)),
              ::testing::Contains(0))
      << "vertex 0 is the lowest corner";
}

TEST(FclCrosscheck, SaysOnlyYesInContact) {
  const Surface surface = cube_surface(1.0);
  const FclCrosscheck fcl(surface, {&surface});
  const FclResult result = fcl.distance(corner_over_face(1.0, -0.1));
  EXPECT_FALSE(result.separated);
  EXPECT_EQ(result.distance, 0.0);
  EXPECT_TRUE(result.point_moving.array().isNaN().all());
  EXPECT_TRUE(result.point_fixed.array().isNaN().all());
}

/// Why the meshes are scaled: at an edge length of 1e-4 the squared cross product of two edges is
/// 1e-16, less than FCL's absolute 1e-15, so that its kernel overlooks the face below the corner.
TEST(FclCrosscheck, ScalingIsNeededForSmallTriangles) {
  constexpr double EDGE = 1e-4;
  constexpr double GAP = 1e-6;
  const Surface surface = cube_surface(EDGE);
  const Pose pose = corner_over_face(EDGE, GAP);
  const FclResult unscaled = FclCrosscheck(surface, {&surface}, FclScaling::NONE).distance(pose);
  EXPECT_GT(std::abs(unscaled.distance - GAP), 0.1 * GAP) << "FCL no longer errs: the scaling may go";
  const FclResult scaled = FclCrosscheck(surface, {&surface}).distance(pose);
  EXPECT_TRUE(scaled.separated);
  EXPECT_NEAR(scaled.distance, GAP, RELATIVE_TOLERANCE * EDGE);
}

TEST(FclCrosscheck, AnswersDoNotDependOnTheUnitOfLength) {
  constexpr double SMALL = 1e-4;
  const Surface large = cube_surface(1.0);
  const Surface small = cube_surface(SMALL);
  const FclCrosscheck fcl_large(large, {&large});
  const FclCrosscheck fcl_small(small, {&small});
  const FclCrosscheck fcl_unscaled(small, {&small}, FclScaling::NONE);
  std::mt19937_64 generator(7);
  int wrong_unscaled = 0;
  for (int i = 0; i < 500; ++i) {
    Pose pose = random_pose(generator, 1.5);
    const double expected = SMALL * fcl_large.distance(pose).distance;
    pose.translation *= SMALL;
    EXPECT_NEAR(fcl_small.distance(pose).distance, expected, RELATIVE_TOLERANCE * SMALL);
    if (std::abs(fcl_unscaled.distance(pose).distance - expected) > 1e-6 * SMALL) ++wrong_unscaled;
  }
  EXPECT_GT(wrong_unscaled, 0) << "the scaling would not be needed";
}

TEST(FclCrosscheck, FinestMeshGetsUnitMeanEdge) {
  const Surface fine = cube_surface(0.01);
  const Surface coarse = cube_surface(3.0, Vec3(5.0, 0.0, 0.0));
  const double expected = 1.0 / mean_edge_length(fine.mesh);
  EXPECT_DOUBLE_EQ(FclCrosscheck(fine, {&coarse}).scale(), expected);
  EXPECT_DOUBLE_EQ(FclCrosscheck(coarse, {&fine}).scale(), expected);
  EXPECT_EQ(FclCrosscheck(fine, {&coarse}, FclScaling::NONE).scale(), 1.0);
}

TEST(FclCrosscheck, NamesTheNearestOfSeveralFixedMeshes) {
  const Surface moving = cube_surface(1.0);
  const Surface left = cube_surface(1.0, Vec3(-3.0, 0.0, 0.0));
  const Surface right = cube_surface(1.0, Vec3(3.0, 0.0, 0.0));
  FclCrosscheck fcl(moving, {&left, &right});
  for (const double x : {-1.0, -0.2, 0.3, 0.9}) {
    const Pose pose{Vec3(x, 0.0, 0.0), Eigen::Quaterniond::Identity()};
    for (const FclResult& result : {fcl.distance(pose), fcl.distance_warm(pose)}) {
      EXPECT_EQ(result.fixed_body, x < 0.0 ? 0 : 1) << "x = " << x;
      EXPECT_NEAR(result.distance, 2.0 - std::abs(x), 1e-12) << "x = " << x;
    }
  }
}

TEST(FclCrosscheck, WarmQueriesAgreeWithColdOnes) {
  const Surface surface = cube_surface(1.0);
  FclCrosscheck fcl(surface, {&surface});
  std::mt19937_64 generator(11);
  int contacts = 0;
  for (int jump = 0; jump < 20; ++jump) {
    Pose pose = random_pose(generator, 1.4);
    const Vec3 step = -0.02 * pose.translation;
    for (int i = 0; i < 30; ++i) {
      const FclResult cold = fcl.distance(pose);
      const FclResult warm = fcl.distance_warm(pose);
      EXPECT_NEAR(warm.distance, cold.distance, 1e-12);
      EXPECT_EQ(warm.separated, cold.separated);
      if (warm.separated)
        EXPECT_NEAR((warm.point_moving - warm.point_fixed).norm(), warm.distance, 1e-9);
      else
        ++contacts;
      pose.translation += step;
    }
    if (jump == 10) fcl.forget();
  }
  EXPECT_GT(contacts, 0) << "the motions should reach contact";
}

TEST(FclCrosscheck, RefusesAMeshWithoutTriangles) {
  const Surface surface = cube_surface(1.0);
  const Surface empty = build_surface(TriangleMesh{});
  EXPECT_THROW(FclCrosscheck(empty, {&surface}), InputError);
  EXPECT_THROW(FclCrosscheck(surface, {&surface, &empty}), InputError);
}

}  // namespace
}  // namespace lmdbench
