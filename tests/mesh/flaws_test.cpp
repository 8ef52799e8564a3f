// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/flaws.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/validity.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lmdbench {
namespace {

ValidityReport report(const TriangleMesh& mesh) {
  return check_mesh(build_surface(mesh));
}

const TriangleMesh SPHERE = make_sphere(1.0, 1);  // 80 triangles

TEST(FlawsTest, TheUnflawedMeshIsSound) {
  EXPECT_TRUE(report(SPHERE).closed);
  EXPECT_TRUE(report(SPHERE).manifold);
}

TEST(FlawsTest, HolesOpenTheMesh) {
  const TriangleMesh holes = with_holes(SPHERE, 8);
  EXPECT_EQ(holes.triangles.size(), 70u);
  EXPECT_EQ(holes.triangles.front(), SPHERE.triangles[1]);
  EXPECT_FALSE(report(holes).closed);
}

TEST(FlawsTest, DuplicatesFollowTheOthers) {
  const TriangleMesh twice = with_duplicates(SPHERE, 40);
  ASSERT_EQ(twice.triangles.size(), 82u);
  EXPECT_EQ(twice.triangles[80], SPHERE.triangles[0]);
  EXPECT_EQ(twice.triangles[81], SPHERE.triangles[40]);
}

TEST(FlawsTest, FlipsTurnNormalsInwards) {
  const Surface surface = build_surface(with_flips(SPHERE, 16));
  int inward = 0;
  for (std::int32_t t = 0; t < 80; ++t)
    if (surface.face_normals[static_cast<std::size_t>(t)].dot(surface.mesh.triangle(t)[0]) < 0.0) ++inward;
  EXPECT_EQ(inward, 5);
}

TEST(FlawsTest, FinsMakeEdgesOfThreeTriangles) {
  const Surface surface = build_surface(with_fins(SPHERE, 20, 0.5));
  EXPECT_EQ(surface.mesh.triangles.size(), 84u);
  EXPECT_EQ(std::count(surface.edge_is_non_manifold.begin(), surface.edge_is_non_manifold.end(), true), 4);
  // The tip stands out of the sphere.
  EXPECT_GT(surface.mesh.vertices.back().norm(), 1.1);
}

TEST(FlawsTest, ZeroAreasHaveNoNormal) {
  const Surface surface = build_surface(with_zero_areas(SPHERE, 40));
  ASSERT_EQ(surface.mesh.triangles.size(), 86u);
  for (std::size_t t = 80; t < 86; ++t) EXPECT_TRUE(surface.face_normals[t].isZero(0.0)) << t;
}

TEST(CapsTest, IsAClosedDrumOfCaps) {
  for (const int count : {3, 4, 7, 8, 96}) {
    const TriangleMesh drum = make_caps(0.5, 0.6, count);
    EXPECT_EQ(drum.triangles.size(), static_cast<std::size_t>(4 * count - 4));
    EXPECT_TRUE(report(drum).closed) << count;
    EXPECT_TRUE(report(drum).manifold) << count;
    EXPECT_EQ(report(drum).boundary_edges, 0) << count;
  }
  // The first ear that was cut off the lower outline.
  const Triangle ear = make_caps(0.5, 0.6, 96).triangle(192);
  double widest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 u = ear[static_cast<std::size_t>((k + 1) % 3)] - ear[static_cast<std::size_t>(k)];
    const Vec3 v = ear[static_cast<std::size_t>((k + 2) % 3)] - ear[static_cast<std::size_t>(k)];
    widest = std::max(widest, std::atan2(u.cross(v).norm(), u.dot(v)));
  }
  EXPECT_NEAR(widest * 180.0 / std::numbers::pi, 180.0 - 360.0 / 96, 1e-5);
}

}  // namespace
}  // namespace lmdbench
