// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/triangle_normal.h>
#include <lmdbench/mesh/validity.h>
#include <lmdbench/mesh/vertex_fan.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::ElementsAre;

/// A sheet with two sides: what is left of normals that cancel is rounding, no direction.
TEST(Surface, NormalsThatCancelHaveNoOuterSide) {
  TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                     {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}}};
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  for (Vec3& vertex : sheet.vertices) vertex = turn * vertex;
  const Surface surface = build_surface(sheet);
  for (std::int32_t v = 0; v < 4; ++v) {
    EXPECT_TRUE(surface.vertex_normal(v).isZero(0.0)) << v;
    EXPECT_FALSE(surface.has_outer_side({FeatureKind::VERTEX, v})) << v;
  }
  std::size_t sides = 0;
  for (std::int32_t e = 0; e < surface.adjacency.edge_count(); ++e) {
    const auto around = surface.adjacency.edge_triangles[e];
    const Vec3 &one = surface.face_normals[static_cast<std::size_t>(around[0])],
               &other = surface.face_normals[static_cast<std::size_t>(around[1])];
    if (one.dot(other) > 0.0) continue;  // a diagonal
    ++sides;
    EXPECT_TRUE(surface.pseudo_normal({FeatureKind::EDGE, e}).isZero(0.0)) << e;
  }
  EXPECT_EQ(sides, 4U);
}

TEST(TriangleNormalTest, IsTheSameAtEveryScale) {
  const Triangle triangle{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  for (const double scale : {0x1p-1070, 1e-300, 1e-150, 1e-9, 1.0, 1e9, 1e150, 1e300}) {
    const Triangle resized{scale * triangle[0], scale * triangle[1], scale * triangle[2]};
    EXPECT_EQ(triangle_normal(resized), Vec3(0, 0, 1)) << scale;
  }
}

TEST(TriangleNormalTest, KeepsItsDigitsOnNeedles) {
  // Side ratio 1e8, in a plane not aligned with the axes; the exact normal is (1, 1, 1) / sqrt(3).
  const Vec3 along = Vec3(1, -1, 0) * 1e8, across(0, 1, -1);
  const Vec3 normal = triangle_normal({Vec3::Zero(), along, along + across});
  EXPECT_LT((normal - Vec3::Ones().normalized()).norm(), 1e-14);
}

TEST(TriangleNormalTest, IsZeroWithoutArea) {
  EXPECT_EQ(triangle_normal({Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(3, 3, 3)}), Vec3::Zero());
  EXPECT_EQ(triangle_normal({Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(0, 0, 0)}), Vec3::Zero());
  EXPECT_EQ(triangle_normal({Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)}), Vec3::Zero());
}

TEST(TriangleNormalTest, CornerAngles) {
  const auto angles = corner_angles({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, std::sqrt(3.0), 0)});
  EXPECT_NEAR(angles[0], std::numbers::pi / 2.0, 1e-15);
  EXPECT_NEAR(angles[1], std::numbers::pi / 3.0, 1e-15);
  EXPECT_NEAR(angles[2], std::numbers::pi / 6.0, 1e-15);
  EXPECT_THAT(corner_angles({Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0)}), ElementsAre(0.0, 0.0, 0.0));
}

TEST(SurfaceTest, BoxHasTheNormalsOfABox) {
  const Surface surface = build_surface(make_box({2, 2, 2}));
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v)
    EXPECT_LT((surface.vertex_pseudo_normals[v] - surface.mesh.vertices[v].normalized()).norm(), 1e-12)
        << "angle weights make the diagonals of the sides irrelevant";
  for (std::size_t e = 0; e < surface.adjacency.edges.size(); ++e) {
    const auto [a, b] = surface.adjacency.edges[e];
    const Vec3 middle = surface.mesh.vertices[static_cast<std::size_t>(a)] +
                        surface.mesh.vertices[static_cast<std::size_t>(b)];
    const Vec3 normal = surface.pseudo_normal({FeatureKind::EDGE, static_cast<std::int32_t>(e)});
    EXPECT_LT((normal - middle.normalized()).norm(), 1e-12);
  }
}

TEST(SurfaceTest, FeaturesOfATriangle) {
  const Surface surface = build_surface(make_box({2, 2, 2}));
  const auto& corners = surface.mesh.triangles[5];
  EXPECT_EQ(surface.feature_of(5, TriangleFeature::V1), (FeatureId{FeatureKind::VERTEX, corners[1]}));
  EXPECT_EQ(surface.feature_of(5, TriangleFeature::FACE), (FeatureId{FeatureKind::FACE, 5}));
  const FeatureId edge = surface.feature_of(5, TriangleFeature::E2);
  EXPECT_EQ(edge.kind, FeatureKind::EDGE);
  EXPECT_THAT(surface.adjacency.edges[static_cast<std::size_t>(edge.index)],
              ElementsAre(std::min(corners[2], corners[0]), std::max(corners[2], corners[0])));
  const TriangleList of_face = surface.incident_triangles({FeatureKind::FACE, 5});
  EXPECT_EQ(std::vector<std::int32_t>(of_face.begin(), of_face.end()), std::vector<std::int32_t>{5});
  EXPECT_EQ(surface.incident_triangles(edge).size(), 2u);
  EXPECT_GE(surface.incident_triangles({FeatureKind::VERTEX, corners[0]}).size(), 3u);
}

TEST(SurfaceTest, FlagsBoundaryAndNonManifoldEdges) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}}};
  const Surface sheet = build_surface(mesh);
  EXPECT_FALSE(sheet.is_boundary({FeatureKind::EDGE, 0}));
  EXPECT_FALSE(sheet.edge_is_non_manifold[0]);
  EXPECT_TRUE(sheet.is_boundary({FeatureKind::EDGE, 1}));
  EXPECT_TRUE(sheet.is_boundary({FeatureKind::VERTEX, 0}));
  EXPECT_FALSE(sheet.is_boundary({FeatureKind::FACE, 0}));

  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_TRUE(build_surface(mesh).edge_is_non_manifold[0]) << "both run the same way";
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}};
  EXPECT_TRUE(build_surface(mesh).edge_is_non_manifold[0]) << "three triangles";
}

TEST(SurfaceTest, MarksTheEndsOfNonManifoldEdges) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                          {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}};
  const Surface surface = build_surface(mesh);
  EXPECT_THAT(surface.vertex_has_non_manifold_edge, ElementsAre(true, true, false, false, false));
  EXPECT_THAT(surface.vertex_is_boundary, ElementsAre(true, true, true, true, true));
}

/// Whether the triangles of each vertex form several fans, connected over edges: by brute force.
std::vector<bool> counted_several_fans(const TriangleMesh& mesh) {
  std::vector<bool> several;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertices.size()); ++v) {
    std::vector<std::set<std::int32_t>>
        fans;  // The other ends of the edges at v; v itself for a side {v, v}.
    const bool has_whole = std::ranges::any_of(mesh.triangles, [&](const auto& corners) {
      return !names_vertex_twice(corners) && std::ranges::find(corners, v) != corners.end();
    });
    for (const auto& corners : mesh.triangles) {
      if (has_whole && names_vertex_twice(corners)) continue;
      std::set<std::int32_t> fan;
      for (std::size_t k = 0; k < 3; ++k)
        if (corners[k] == v) fan.insert({corners[(k + 1) % 3], corners[(k + 2) % 3]});
      if (fan.empty()) continue;
      std::erase_if(fans, [&](std::set<std::int32_t>& other) {
        if (std::ranges::none_of(other, [&](std::int32_t end) { return fan.contains(end); })) return false;
        fan.merge(other);
        return true;
      });
      fans.push_back(fan);
    }
    several.push_back(fans.size() > 1);
  }
  return several;
}

TEST(SurfaceTest, KnowsWhereTrianglesAreSeveralFans) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}},
                    {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}}};
  const Surface two_solids = build_surface(mesh);
  EXPECT_THAT(two_solids.vertex_has_several_fans,
              ElementsAre(true, false, false, false, false, false, false));
  EXPECT_FALSE(two_solids.has_outer_side({FeatureKind::VERTEX, 0}));
  EXPECT_TRUE(two_solids.has_outer_side({FeatureKind::VERTEX, 1}));
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_TRUE(build_surface(mesh).vertex_has_several_fans[0]) << "two open sheets";
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_FALSE(build_surface(mesh).vertex_has_several_fans[0]) << "one open sheet";
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const Surface book = build_surface(mesh);
  EXPECT_FALSE(book.vertex_has_several_fans[0]) << "they hang together over the edge of all";
  EXPECT_FALSE(book.has_outer_side({FeatureKind::VERTEX, 0}));
  EXPECT_FALSE(book.has_outer_side({FeatureKind::EDGE, 0}));
  mesh.triangles = {{0, 1, 2}, {1, 0, 2}};
  const Surface two_sheets = build_surface(mesh);
  EXPECT_FALSE(two_sheets.vertex_has_several_fans[0]);
  EXPECT_FALSE(two_sheets.has_outer_side({FeatureKind::VERTEX, 0})) << "no normal";
}

/// Many triangles at random on few vertices: open, with edges of many triangles, turned over,
/// duplicated, and with repeated corners.
TEST(SurfaceTest, KnowsTheFansOfTrianglesThrownTogether) {
  std::mt19937_64 random(11);
  std::size_t several = 0, one = 0;
  for (int sample = 0; sample < 3000; ++sample) {
    TriangleMesh mesh = make_sphere(1.0, 0);
    std::uniform_int_distribution<std::int32_t> vertex(0,
                                                       static_cast<std::int32_t>(mesh.vertices.size()) - 1);
    if (sample % 2 == 0) mesh.triangles.clear();
    for (int k = 0; k < sample % 9; ++k)
      mesh.triangles.push_back({vertex(random), vertex(random), vertex(random)});
    const std::vector<bool> counted = counted_several_fans(mesh);
    ASSERT_EQ(build_surface(mesh).vertex_has_several_fans, counted) << "sample " << sample;
    for (const bool of_vertex : counted) ++(of_vertex ? several : one);
  }
  EXPECT_GT(several, 1000u);
  EXPECT_GT(one, 1000u);
}

TEST(SurfaceTest, IsCompact) {
  const Surface surface = build_surface(make_sphere(1.0, 5));
  EXPECT_LE(surface.bytes(), 114 * surface.mesh.triangles.size());
}

TEST(SurfaceTest, NeighboursAreTheOtherEndsOfEdges) {
  TriangleMesh holed = make_blob(1.0, 0.3, 2);
  holed.triangles.erase(holed.triangles.begin() + 5);
  std::swap(holed.triangles[40][0], holed.triangles[40][1]);  // disagrees with its neighbours
  holed.triangles.push_back({7, 7, 9});
  holed.triangles.push_back({7, 7, 9});
  const Surface surface = build_surface(holed);
  std::vector<std::set<std::int32_t>> expected(holed.vertices.size()), found(holed.vertices.size());
  for (const auto& [a, b] : surface.adjacency.edges) {
    if (a == b || (a == 7 && b == 9)) continue;  // no triangle has that edge but collapsed ones
    expected[static_cast<std::size_t>(a)].insert(b);
    expected[static_cast<std::size_t>(b)].insert(a);
  }
  for (std::size_t v = 0; v < found.size(); ++v) {
    const auto vertex = static_cast<std::int32_t>(v);
    std::size_t visits = 0;
    EXPECT_TRUE(for_each_neighbour(surface, vertex, [&](std::int32_t neighbour) {
      found[v].insert(neighbour);
      ++visits;
      return true;
    }));
    if (!surface.vertex_is_boundary[v] && !surface.vertex_has_non_manifold_edge[v]) {
      EXPECT_EQ(visits, found[v].size()) << "vertex " << v;
    }
  }
  EXPECT_EQ(found, expected);
  EXPECT_FALSE(for_each_neighbour(surface, 0, [](std::int32_t) { return false; }));
}

/// As rounding to single precision leaves them of slivers: no feature of others changes.
TEST(SurfaceTest, CollapsedTrianglesLeaveAClosedMeshAsItIs) {
  const TriangleMesh box = make_box({1, 1, 1}, 2);
  TriangleMesh more = box;
  for (const auto& corners : {box.triangles[0], box.triangles[7], box.triangles[20]}) {
    more.triangles.insert(more.triangles.begin(), {corners[0], corners[1], corners[0]});
    more.triangles.push_back({corners[1], corners[2], corners[2]});
    more.triangles.push_back({corners[2], corners[2], corners[2]});
  }
  const Surface whole = build_surface(box), surface = build_surface(more);
  EXPECT_EQ(surface.vertex_pseudo_normals, whole.vertex_pseudo_normals);
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(box.vertices.size()); ++v)
    EXPECT_TRUE(surface.has_outer_side({FeatureKind::VERTEX, v})) << v;
  for (std::int32_t e = 0; e < surface.adjacency.edge_count(); ++e) {
    const auto& [a, b] = surface.adjacency.edges[static_cast<std::size_t>(e)];
    if (a == b) continue;
    EXPECT_TRUE(surface.has_outer_side({FeatureKind::EDGE, e})) << a << ", " << b;
    EXPECT_EQ(surface.adjacency.edge_triangles[e].size(), 2U) << a << ", " << b;
  }
  const ValidityReport report = check_mesh(surface);
  EXPECT_TRUE(report.closed && report.manifold && report.consistently_oriented);
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.degenerate_triangles, 9);
  for (const std::int32_t t : surface.adjacency.collapsed)
    for (const TriangleFeature part : {TriangleFeature::V0, TriangleFeature::V2, TriangleFeature::E0,
                                       TriangleFeature::E1, TriangleFeature::E2, TriangleFeature::FACE}) {
      const FeatureId feature = surface.feature_of(t, part);
      EXPECT_TRUE(surface.holds(t, feature)) << t;
      EXPECT_FALSE(surface.holds(t, {feature.kind, feature.index + 12345})) << t;
    }
}

TEST(SurfaceTest, TrianglesWithoutAreaAddNothing) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 3, 1}, {0, 0, 2}}};
  const Surface surface = build_surface(mesh);
  EXPECT_EQ(surface.face_normals[1], Vec3::Zero());
  EXPECT_EQ(surface.face_normals[2], Vec3::Zero());
  EXPECT_EQ(surface.vertex_pseudo_normals[0], Vec3(0, 0, 1));
  EXPECT_EQ(surface.vertex_pseudo_normals[3], Vec3::Zero());
}

}  // namespace
}  // namespace lmdbench
