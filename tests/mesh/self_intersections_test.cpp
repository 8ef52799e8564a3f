// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/geometry/triangle_intersection.h>
#include <lmdbench/mesh/flaws.h>
#include <lmdbench/mesh/self_intersections.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;

TriangleMesh two_triangles(const Triangle& a, const Triangle& b) {
  TriangleMesh mesh;
  for (const Triangle& t : {a, b}) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), t.begin(), t.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

const Triangle FLAT{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};

TEST(SelfIntersections, SoundSolidsHaveNone) {
  for (const TriangleMesh& mesh : {make_sphere(1, 3), make_box({1, 2, 3}, 5), make_torus(1, 0.3, 32, 16),
                                   make_blob(1, 0.3, 3), make_needles(1, 4, 50), make_l_block(1)}) {
    const SelfIntersections found = self_intersections(mesh);
    EXPECT_EQ(found.pairs, 0) << to_text(found);
    EXPECT_TRUE(found.complete);
    EXPECT_EQ(to_text(found), "none");
  }
}

TEST(SelfIntersections, SolidsThatCrossAreFound) {
  const TriangleMesh mesh = merged(make_box({1, 1, 1}), translated(make_box({1, 1, 1}), {0.5, 0.3, 0.2}));
  // Brute force: every pair.
  std::int64_t expected = 0;
  for (std::int32_t i = 0; i < 12; ++i)
    for (std::int32_t j = 12; j < 24; ++j)
      expected += triangles_intersect(mesh.triangle(i), mesh.triangle(j)) ? 1 : 0;
  const SelfIntersections found = self_intersections(mesh);
  EXPECT_GT(expected, 0);
  EXPECT_EQ(found.pairs, expected);
  EXPECT_THAT(to_text(found), HasSubstr("pairs of triangles touch or cross"));
}

/// The tree finds the same pairs as brute force.
TEST(SelfIntersections, RandomTrianglesAgreeWithEveryPair) {
  std::mt19937_64 random(3);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  TriangleMesh mesh;
  for (int t = 0; t < 200; ++t) {
    const Vec3 centre(uniform(), uniform(), uniform());
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(centre + 0.2 * Vec3(uniform(), uniform(), uniform()));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  std::int64_t expected = 0;
  for (std::int32_t i = 0; i < 200; ++i)
    for (std::int32_t j = i + 1; j < 200; ++j)
      expected += triangles_intersect(mesh.triangle(i), mesh.triangle(j)) ? 1 : 0;
  EXPECT_GT(expected, 10);
  EXPECT_EQ(self_intersections(mesh).pairs, expected);
}

TEST(SelfIntersections, NeighboursAreToldFromFolds) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  struct Case {
    Triangle other;
    bool meets;
    const char* what;
  };
  const Case cases[] = {
      {{o, y, Vec3(-1, 0, 0)}, false, "beside it, over a common side"},
      {{o, x, Vec3(0.2, 0.9, 0)}, true, "folded over a common side"},
      {{o, x, Vec3(0.2, 0.9, 1e-30)}, false, "all but folded over it"},
      {{o, x, Vec3(0.2, -0.9, 0)}, false, "the other side of a common side"},
      {{o, Vec3(-1, 0, 1), Vec3(0, -1, 1)}, false, "at a common corner"},
      {{o, Vec3(1, 1, 1), Vec3(1, 1, -1)}, true, "through it from a common corner"},
      {{o, Vec3(2, 2, 0), Vec3(3, 0, 0)}, true, "in its plane over it from a common corner"},
      {{o, Vec3(2, 0, 0), Vec3(0, 0, 1)}, true, "on along a common side"},
      {{Vec3(0.2, 0.2, 0), Vec3(0.2, 0.2, 1), Vec3(0.3, 0.2, 1)}, true, "a corner on its face"},
      {{Vec3(0.2, 0.2, 1e-30), Vec3(0.2, 0.2, 1), Vec3(0.3, 0.2, 1)}, false, "a corner just above its face"},
      {FLAT, false, "a duplicate, which the validity report counts"},
  };
  for (const Case& c : cases)
    EXPECT_EQ(self_intersections(two_triangles(FLAT, c.other)).pairs, c.meets ? 1 : 0) << c.what;
}

TEST(SelfIntersections, ScaleAndPlainFlawsDoNotMatter) {
  for (const double size : {1e-60, 1.0, 1e60}) {
    TriangleMesh mesh = merged(make_box({1, 1, 1}), translated(make_box({1, 1, 1}), {0.5, 0.3, 0.2}));
    const std::int64_t expected = self_intersections(mesh).pairs;
    for (Vec3& vertex : mesh.vertices) vertex *= size;
    EXPECT_EQ(self_intersections(mesh).pairs, expected) << size;
  }
  EXPECT_EQ(self_intersections(with_duplicates(make_sphere(1, 2), 5)).pairs, 0);
  EXPECT_EQ(self_intersections(with_zero_areas(make_sphere(1, 2), 5)).pairs, 0);
  EXPECT_EQ(self_intersections(TriangleMesh{}).pairs, 0);
}

TEST(SelfIntersections, SaysWhereItEnded) {
  TriangleMesh pile;
  for (int i = 0; i < 100; ++i)
    pile = merged(pile, two_triangles(FLAT, {Vec3(0.1, 0.1, -1), Vec3(0.2, 0.1, 1), Vec3(0.1, 0.2, 1)}));
  const SelfIntersections found = self_intersections(pile, 50);
  EXPECT_FALSE(found.complete);
  EXPECT_LE(found.pairs, 50);
  EXPECT_THAT(to_text(found), HasSubstr("the search ended"));
}

}  // namespace
}  // namespace lmdbench
