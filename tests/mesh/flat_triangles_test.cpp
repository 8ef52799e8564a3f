// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/flat_triangles.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/validity.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace lmdbench {
namespace {

/// Two squares beside x = 0; corners 6 and on lie on their common side, and the left one has none.
TriangleMesh junction(const std::vector<double>& places) {
  TriangleMesh mesh{{{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {1, 0, 0}, {1, 1, 0}},
                    {{0, 1, 3}, {1, 2, 3}, {1, 4, 5}}};
  std::int32_t last = 1;
  for (const double y : places) {
    const auto corner = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back(0.0, y, 0.0);
    mesh.triangles.push_back({last, 5, corner});
    mesh.triangles.push_back({last, corner, 2});  // Without area.
    last = corner;
  }
  mesh.triangles.push_back({last, 5, 2});
  return mesh;
}

void expect_same_square(const TriangleMesh& mesh) {
  const Surface surface = build_surface(mesh);
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_EQ(surface.face_normals[t], Vec3::UnitZ()) << t;
    const Triangle corners = mesh.triangle(static_cast<std::int32_t>(t));
    area += 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
  }
  EXPECT_NEAR(area, 2.0, 1e-15);
  const ValidityReport report = check_mesh(surface);
  EXPECT_EQ(report.degenerate_triangles, 0);
  EXPECT_TRUE(report.non_manifold_edges == 0);
}

TEST(FlatTriangles, OfATJunctionAreFlipped) {
  for (const auto& places : {std::vector{0.5}, {0.25, 0.75}, {0.1, 0.3, 0.35, 0.9}}) {
    TriangleMesh mesh = junction(places);
    EXPECT_EQ(flip_flat_triangles(mesh), std::ssize(places));
    expect_same_square(mesh);
    EXPECT_EQ(flip_flat_triangles(mesh), 0);
  }
}

/// The farther one has no face with area beside it until the nearer one is flipped.
TEST(FlatTriangles, BehindOneAnotherAreFlipped) {
  TriangleMesh mesh = junction({});
  mesh.vertices.insert(mesh.vertices.end(), {{0, 0.25, 0}, {0, 0.5, 0}});
  mesh.triangles = {{6, 7, 1}, {0, 1, 3}, {1, 2, 3}, {1, 4, 5}, {1, 7, 2}, {1, 5, 6}, {6, 5, 7}, {7, 5, 2}};
  EXPECT_EQ(flip_flat_triangles(mesh), 2);
  expect_same_square(mesh);
}

TEST(FlatTriangles, OfAHeightAreFlippedToo) {
  for (const double off : {1e-8, -1e-8}) {
    TriangleMesh mesh = junction({0.3, 0.6});
    mesh.vertices[6].x() = off;
    TriangleMesh low = mesh;
    EXPECT_EQ(flip_flat_triangles(mesh), 0) << "both are higher than nothing";
    EXPECT_EQ(flip_flat_triangles(low, 1e-7), 2);
  }
}

/// Each waits for the next one: in the worst order all are asked again, each once.
TEST(FlatTriangles, OfALongFanAreFlipped) {
  std::vector<double> places;
  for (int i = 1; i < 500; ++i) places.push_back(i / 500.0);
  for (const bool reversed : {false, true}) {
    TriangleMesh mesh = junction(places);
    if (reversed) std::ranges::reverse(mesh.triangles);
    EXPECT_EQ(flip_flat_triangles(mesh), 499);
  }
}

TEST(FlatTriangles, AreLeftWhereAFlipWouldChangeTheSurface) {
  const auto expect_left = [](const TriangleMesh& mesh) {
    TriangleMesh same = mesh;
    EXPECT_EQ(flip_flat_triangles(same), 0);
    EXPECT_EQ(same.triangles, mesh.triangles);
  };
  expect_left(make_box({1, 1, 1}));
  TriangleMesh border = junction({0.5});
  std::erase(border.triangles, std::array<std::int32_t, 3>{1, 2, 3});
  expect_left(border);
  TriangleMesh turned = junction({0.5});
  std::swap(turned.triangles[1][0], turned.triangles[1][1]);
  expect_left(turned);
  TriangleMesh fin = junction({0.5});
  fin.triangles.push_back({1, 2, 4});
  expect_left(fin);
  TriangleMesh edge_is_there = junction({0.5});
  edge_is_there.triangles.push_back({3, 6, 4});
  expect_left(edge_is_there);
  // A corner at an end of the longest side: nothing lies on the side.
  expect_left(junction({0.0}));
  // Nor where it is next to it: what is cut off would be flat again.
  TriangleMesh beside = junction({1e-8});
  EXPECT_EQ(flip_flat_triangles(beside, 1e-7), 0);
  EXPECT_EQ(flip_flat_triangles(beside, 1e-9), 1);
}

}  // namespace
}  // namespace lmdbench
