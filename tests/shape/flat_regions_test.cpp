// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/shape/flat_regions.h>

#include <gtest/gtest.h>
#include <support/rounded.h>

#include <algorithm>
#include <map>

namespace lmdbench {
namespace {

std::ptrdiff_t inner_vertices(const FlatRegions& regions) {
  return std::count(regions.vertex_is_inside.begin(), regions.vertex_is_inside.end(), true);
}

TEST(FlatRegions, ABoxHasSixFacesTwelveEdgesAndEightCorners) {
  for (const int cells : {1, 2, 7}) {
    for (const bool is_turned : {false, true}) {
      TriangleMesh mesh = make_box(Vec3(1.0, 0.6, 0.3), cells);
      if (is_turned) mesh = testing::turned(std::move(mesh), 11);
      const Surface surface = build_surface(std::move(mesh));
      const FlatRegions regions = FlatRegions::of(surface);
      EXPECT_EQ(regions.region_count(), 6);
      EXPECT_EQ(regions.straight_edges.size(), 12u);
      EXPECT_EQ(static_cast<std::ptrdiff_t>(surface.mesh.vertices.size()) - inner_vertices(regions), 8);
      for (std::int32_t r = 0; r < 6; ++r) {
        const auto border = regions.straight_edges_of_region[r];
        EXPECT_EQ(border.size(), 4u);
        for (const std::int32_t s : border) {
          const auto beside = surface.adjacency.edge_triangles[regions.edges_of_straight[s].front()];
          EXPECT_EQ(std::ranges::count(beside, r,
                                       [&](std::int32_t t) {
                                         return regions.region_of_triangle[static_cast<std::size_t>(t)];
                                       }),
                    1);
        }
      }
      for (std::int32_t s = 0; s < 12; ++s) {
        const StraightEdge& straight = regions.straight_edges[static_cast<std::size_t>(s)];
        EXPECT_EQ(regions.edges_of_straight[s].size(), static_cast<std::size_t>(cells));
        // The chain's edges connect its first end with its second one.
        std::int32_t at = straight.ends[0];
        for (const std::int32_t e : regions.edges_of_straight[s]) {
          const auto& ends = surface.adjacency.edges[static_cast<std::size_t>(e)];
          ASSERT_TRUE(ends[0] == at || ends[1] == at);
          at = ends[0] == at ? ends[1] : ends[0];
        }
        EXPECT_EQ(at, straight.ends[1]);
      }
    }
  }
}

TEST(FlatRegions, AnLShapedFaceIsOneRegion) {
  const Surface surface = build_surface(make_l_block(1.0));
  const FlatRegions regions = FlatRegions::of(surface);
  EXPECT_EQ(regions.region_count(), 8);
  EXPECT_EQ(regions.straight_edges.size(), 18u);
}

TEST(FlatRegions, CurvedShapesKeepTheirFeatures) {
  const Surface surface = build_surface(make_blob(0.5, 0.1, 4));
  const FlatRegions regions = FlatRegions::of(surface);
  EXPECT_EQ(regions.region_count(), static_cast<std::int32_t>(surface.mesh.triangles.size()));
  EXPECT_EQ(regions.straight_edges.size(), surface.adjacency.edges.size());
  EXPECT_EQ(inner_vertices(regions), 0);
}

TEST(FlatRegions, OpenSheetsHaveStraightBoundaries) {
  const Surface surface = build_surface(make_patch(1.0, 5, 0.0));
  const FlatRegions regions = FlatRegions::of(surface);
  EXPECT_EQ(regions.region_count(), 1);
  EXPECT_EQ(regions.straight_edges.size(), 4u);
  EXPECT_EQ(regions.straight_edges_of_region[0].size(), 4u);
}

TEST(FlatRegions, AnEdgeOfThreeFacesIsOnTheBorderOfEach) {
  TriangleMesh mesh{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.5, 1.0, 0.0}, {0.5, -1.0, 0.0}, {0.5, 0.0, 1.0}},
                    {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
  const Surface surface = build_surface(std::move(mesh));
  const FlatRegions regions = FlatRegions::of(surface);
  ASSERT_EQ(regions.region_count(), 3);
  EXPECT_EQ(regions.straight_edges.size(), 7u);
  for (std::int32_t r = 0; r < 3; ++r) EXPECT_EQ(regions.straight_edges_of_region[r].size(), 3u);
}

TEST(FlatRegions, NamesTheFirstEdgeAtAPoint) {
  // Points beside a line and beyond its ends count as the nearest one on it. The second box has
  // edges only a few tolerances long; the third's are in the other order along their lines.
  TriangleMesh turned_round = make_box(Vec3(1.0, 1.0, 1.0), 17);
  std::ranges::reverse(turned_round.triangles);
  for (const TriangleMesh& mesh :
       {make_box(Vec3(1.0, 1.0, 1.0), 17), make_box(Vec3(1.0, 30.0, 2e-6), 17), turned_round}) {
    const Surface surface = build_surface(mesh);
    const FlatRegions regions = FlatRegions::of(surface);
    const auto vertex = [&](std::int32_t v) { return surface.mesh.vertices[static_cast<std::size_t>(v)]; };
    for (std::size_t s = 0; s < regions.straight_edges.size(); ++s) {
      const auto straight = static_cast<std::int32_t>(s);
      const auto edges = regions.edges_of_straight[straight];
      ASSERT_EQ(edges.size(), 17u);
      const auto& line = regions.straight_edges[s].ends;
      const Vec3 beside = 1e-3 * (vertex(line[1]) - vertex(line[0])).unitOrthogonal();
      std::map<std::int32_t, std::int32_t> first_at;
      for (const std::int32_t e : edges) {
        const auto& ends = surface.adjacency.edges[static_cast<std::size_t>(e)];
        EXPECT_EQ(regions.edge_at(surface, straight, 0.5 * (vertex(ends[0]) + vertex(ends[1])) + beside), e);
        for (const std::int32_t v : ends) {
          std::int32_t& first = first_at.try_emplace(v, e).first->second;
          first = std::min(first, e);
        }
      }
      for (const auto& [v, first] : first_at) EXPECT_EQ(regions.edge_at(surface, straight, vertex(v)), first);
      const Vec3 beyond = 2.0 * vertex(line[1]) - vertex(line[0]);
      EXPECT_EQ(regions.edge_at(surface, straight, beyond), first_at[line[1]]);
    }
  }
}

}  // namespace
}  // namespace lmdbench
