// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/adjacency.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::ElementsAre;

TEST(AdjacencyTest, NumbersEdgesInTheOrderOfTheirFirstSide) {
  TriangleMesh mesh;
  mesh.vertices.assign(4, Vec3::Zero());
  mesh.triangles = {{3, 1, 2}, {1, 3, 0}};
  const Adjacency adjacency = build_adjacency(mesh);
  using Edge = std::array<std::int32_t, 2>;
  EXPECT_THAT(adjacency.edges, ElementsAre(Edge{1, 3}, Edge{1, 2}, Edge{2, 3}, Edge{0, 3}, Edge{0, 1}));
  EXPECT_THAT(adjacency.triangle_edges[0], ElementsAre(0, 1, 2));
  EXPECT_THAT(adjacency.triangle_edges[1], ElementsAre(0, 3, 4));
  EXPECT_THAT(adjacency.edge_triangles[0], ElementsAre(0, 1));
  EXPECT_THAT(adjacency.edge_triangles[3], ElementsAre(1));
  EXPECT_THAT(adjacency.vertex_triangles[3], ElementsAre(0, 1));
  EXPECT_THAT(adjacency.vertex_triangles[0], ElementsAre(1));
}

TEST(AdjacencyTest, ListsATriangleOncePerEdge) {
  EdgeTriangles lists(2);
  EXPECT_TRUE(lists[0].empty());
  for (const std::int32_t triangle : {3, 3, 5, 5, 8, 8, 9}) lists.add(0, triangle);
  EXPECT_THAT(lists[0], ElementsAre(3, 5, 8, 9));
  EXPECT_TRUE(lists[1].empty());
  lists.add(1, 4);
  EXPECT_THAT(lists[1], ElementsAre(4));
}

// Random triangles. On few vertices every edge has many triangles, some twice, and corners may be
// equal; on many vertices there is work for several tasks.
class RandomAdjacencyTest : public ::testing::TestWithParam<std::int32_t> {};

TEST_P(RandomAdjacencyTest, IsWhatTheDefinitionsSay) {
  const std::int32_t vertex_count = GetParam();
  std::mt19937 random(5);
  TriangleMesh mesh;
  mesh.vertices.assign(static_cast<std::size_t>(vertex_count), Vec3::Zero());
  const auto vertex = [&] {
    return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(vertex_count));
  };
  for (int t = 0; t < 30000; ++t) mesh.triangles.push_back({vertex(), vertex(), vertex()});
  const Adjacency adjacency = build_adjacency(mesh);

  using Edge = std::array<std::int32_t, 2>;
  std::map<Edge, std::int32_t> numbers;
  std::vector<Edge> edges;
  std::vector<std::vector<std::int32_t>> edge_triangles, vertex_triangles(mesh.vertices.size());
  const auto add_once = [](std::vector<std::int32_t>& list, std::int32_t item) {
    if (list.empty() || list.back() != item) list.push_back(item);
  };
  for (std::int32_t t = 0; t < 30000; ++t) {
    const auto& corners = mesh.triangles[static_cast<std::size_t>(t)];
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge{std::min(corners[k], corners[(k + 1) % 3]), std::max(corners[k], corners[(k + 1) % 3])};
      const auto [place, is_new] = numbers.emplace(edge, static_cast<std::int32_t>(edges.size()));
      if (is_new) edges.push_back(edge);
      ASSERT_EQ(adjacency.triangle_edges[static_cast<std::size_t>(t)][k], place->second);
    }
  }
  edge_triangles.resize(edges.size());
  const auto has_whole = [&](const std::vector<std::int32_t>& list) {
    return !list.empty() && !names_vertex_twice(mesh.triangles[static_cast<std::size_t>(list.front())]);
  };
  for (const bool collapsed : {false, true}) {
    for (std::int32_t t = 0; t < 30000; ++t) {
      const auto& corners = mesh.triangles[static_cast<std::size_t>(t)];
      if (names_vertex_twice(corners) != collapsed) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        auto& of_edge = edge_triangles[static_cast<std::size_t>(
            adjacency.triangle_edges[static_cast<std::size_t>(t)][k])];
        auto& of_vertex = vertex_triangles[static_cast<std::size_t>(corners[k])];
        if (!collapsed || !has_whole(of_edge)) add_once(of_edge, t);
        if (!collapsed || !has_whole(of_vertex)) add_once(of_vertex, t);
      }
    }
  }
  ASSERT_EQ(adjacency.edges, edges);
  for (std::int32_t e = 0; e < adjacency.edge_count(); ++e)
    ASSERT_TRUE(std::ranges::equal(adjacency.edge_triangles[e], edge_triangles[static_cast<std::size_t>(e)]));
  for (std::int32_t v = 0; v < vertex_count; ++v)
    ASSERT_TRUE(
        std::ranges::equal(adjacency.vertex_triangles[v], vertex_triangles[static_cast<std::size_t>(v)]));
}

INSTANTIATE_TEST_SUITE_P(Vertices, RandomAdjacencyTest, ::testing::Values(2, 20, 300, 20000));

}  // namespace
}  // namespace lmdbench
