// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/surface.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/signed_volume.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace lmdbench {
namespace {

struct NamedShape {
  std::string name;
  TriangleMesh mesh;
  std::size_t triangles;
  int euler;
};

class ClosedShapeTest : public ::testing::TestWithParam<NamedShape> {};

TEST_P(ClosedShapeTest, IsClosedManifoldOrientedOutwards) {
  const NamedShape& shape = GetParam();
  const Surface surface = build_surface(shape.mesh);
  EXPECT_EQ(shape.mesh.triangles.size(), shape.triangles);
  EXPECT_EQ(static_cast<int>(shape.mesh.vertices.size()) - surface.adjacency.edge_count() +
                static_cast<int>(shape.triangles),
            shape.euler);
  EXPECT_EQ(std::count(surface.edge_is_boundary.begin(), surface.edge_is_boundary.end(), true), 0);
  EXPECT_EQ(std::count(surface.edge_is_non_manifold.begin(), surface.edge_is_non_manifold.end(), true), 0);
  EXPECT_GT(testing::signed_volume(shape.mesh), 0.0);
  for (const Vec3& normal : surface.face_normals) EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
  EXPECT_LT(bounding_box_centre(shape.mesh).norm(), 0.3 * bounding_box_diagonal(shape.mesh));
}

INSTANTIATE_TEST_SUITE_P(Shapes, ClosedShapeTest,
                         ::testing::Values(NamedShape{"sphere", make_sphere(2.0, 2), 320, 2},
                                           NamedShape{"box", make_box({1, 2, 3}), 12, 2},
                                           NamedShape{"fine_box", make_box({1, 2, 3}, 4), 192, 2},
                                           NamedShape{"torus", make_torus(1.0, 0.3, 16, 8), 256, 0},
                                           NamedShape{"blob", make_blob(1.0, 0.3, 3), 1280, 2},
                                           NamedShape{"unequal", make_unequal(1.0, 9, 1000.0), 972, 2},
                                           NamedShape{"needles", make_needles(1.0, 4.0, 300), 1200, 2},
                                           NamedShape{"wedge", make_wedge(1.0, 2.0, 1.0), 8, 2},
                                           NamedShape{"l_block", make_l_block(1.0), 20, 2},
                                           NamedShape{"two_boxes", make_two_boxes({1, 1, 1}, 0.1), 24, 4}),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(ShapesTest, VolumesAreThoseOfTheSolids) {
  EXPECT_NEAR(testing::signed_volume(make_box({1, 2, 3}, 3)), 6.0, 1e-12);
  EXPECT_NEAR(testing::signed_volume(make_wedge(1.0, 2.0, 3.0)), 3.0, 1e-12);
  EXPECT_NEAR(testing::signed_volume(make_l_block(2.0)), 6.0, 1e-12);
  EXPECT_NEAR(testing::signed_volume(make_sphere(1.0, 4)), 4.0 / 3.0 * M_PI, 0.02);
  EXPECT_NEAR(testing::signed_volume(make_torus(1.0, 0.25, 128, 64)), 2.0 * M_PI * M_PI * 0.0625, 0.01);
}

TEST(ShapesTest, UnequalShapeHasTheRatioItPromises) {
  const TriangleMesh mesh = make_unequal(1.0, 16, 1000.0);
  double least = 1e300, most = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle corners = mesh.triangle(static_cast<std::int32_t>(t));
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = (corners[(k + 1) % 3] - corners[k]).norm();
      least = std::min(least, length);
      most = std::max(most, length);
    }
  }
  EXPECT_GT(most / least, 500.0);
  EXPECT_LT(most / least, 20000.0);
}

TEST(ShapesTest, NeedlesAreNeedles) {
  const Surface surface = build_surface(make_needles(0.3, 1.2, 600));
  for (std::int32_t t = 0; t < 2400; ++t) {
    const Triangle corners = surface.mesh.triangle(t);
    const double side = (corners[2] - corners[0]).norm();
    const double double_area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
    EXPECT_GT(side * side / double_area, 100.0);
  }
}

TEST(ShapesTest, PatchHasOneBoundaryRoundItsSquare) {
  const Surface surface = build_surface(make_patch(2.0, 8, 0.1));
  EXPECT_EQ(std::count(surface.edge_is_boundary.begin(), surface.edge_is_boundary.end(), true), 32);
  EXPECT_EQ(std::count(surface.vertex_is_boundary.begin(), surface.vertex_is_boundary.end(), true), 32);
  for (const Vec3& normal : surface.face_normals) EXPECT_GT(normal.z(), 0.0);
}

TEST(ShapesTest, TwoBoxesAreTheGapApart) {
  const TriangleMesh mesh = make_two_boxes({2, 1, 1}, 0.5);
  double left = -1e300, right = 1e300;
  for (const Vec3& vertex : mesh.vertices)
    (vertex.x() < 0 ? left : right) =
        vertex.x() < 0 ? std::max(left, vertex.x()) : std::min(right, vertex.x());
  EXPECT_DOUBLE_EQ(right - left, 0.5);
}

TEST(TriangleMeshTest, SizesOfABox) {
  const TriangleMesh box = translated(make_box({3, 4, 12}), {100, 0, 0});
  EXPECT_DOUBLE_EQ(bounding_box_diagonal(box), 13.0);
  EXPECT_TRUE(bounding_box_centre(box).isApprox(Vec3(100, 0, 0)));
  const double sides = 3 + 4 + 5 + 4 + 12 + std::sqrt(160.0) + 12 + 3 + std::sqrt(153.0);
  EXPECT_NEAR(mean_edge_length(box), sides / 9.0, 1e-12);
}

TEST(TriangleMeshTest, EmptyMeshHasNoSize) {
  EXPECT_EQ(bounding_box_diagonal({}), 0.0);
  EXPECT_EQ(mean_edge_length({}), 0.0);
  EXPECT_EQ(bounding_box_centre({}), Vec3::Zero());
}

}  // namespace
}  // namespace lmdbench
