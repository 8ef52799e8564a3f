// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/mesh/adjacency.h>
#include <lmdbench/mesh/shapes.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

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
  EXPECT_THAT(adjacency.vertex_edges[3], ElementsAre(0, 2, 3));
}

TEST(AdjacencyTest, KeepsAllTrianglesOfANonManifoldEdge) {
  TriangleMesh mesh;
  mesh.vertices.assign(5, Vec3::Zero());
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const Adjacency adjacency = build_adjacency(mesh);
  EXPECT_THAT(adjacency.edge_triangles[0], ElementsAre(0, 1, 2));
}

TEST(AdjacencyTest, TriangleThatNamesAVertexTwiceStandsOnceInEachRow) {
  TriangleMesh mesh;
  mesh.vertices.assign(2, Vec3::Zero());
  mesh.triangles = {{0, 0, 1}};
  const Adjacency adjacency = build_adjacency(mesh);
  EXPECT_EQ(adjacency.edge_count(), 2);
  EXPECT_THAT(adjacency.edge_triangles[1], ElementsAre(0));
  EXPECT_THAT(adjacency.vertex_triangles[0], ElementsAre(0));
  EXPECT_THAT(adjacency.vertex_edges[0], ElementsAre(0, 1));
  EXPECT_THAT(adjacency.vertex_edges[1], ElementsAre(1));
}

TEST(AdjacencyTest, UnusedVerticesHaveEmptyRows) {
  TriangleMesh mesh;
  mesh.vertices.assign(5, Vec3::Zero());
  mesh.triangles = {{0, 1, 2}};
  const Adjacency adjacency = build_adjacency(mesh);
  EXPECT_EQ(adjacency.vertex_triangles.row_count(), 5);
  EXPECT_TRUE(adjacency.vertex_triangles[4].empty());
}

TEST(AdjacencyTest, RowsAgreeWithTheTriangles) {
  const TriangleMesh mesh = make_blob(1.0, 0.3, 3);
  const Adjacency adjacency = build_adjacency(mesh);
  EXPECT_EQ(2 * adjacency.edges.size(), 3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t tail = mesh.triangles[t][k], head = mesh.triangles[t][(k + 1) % 3];
      const std::int32_t edge = adjacency.triangle_edges[t][k];
      EXPECT_THAT(adjacency.edges[static_cast<std::size_t>(edge)],
                  ElementsAre(std::min(tail, head), std::max(tail, head)));
      const auto on_edge = adjacency.edge_triangles[edge];
      EXPECT_EQ(std::count(on_edge.begin(), on_edge.end(), static_cast<std::int32_t>(t)), 1);
      const auto round_tail = adjacency.vertex_triangles[tail];
      EXPECT_EQ(std::count(round_tail.begin(), round_tail.end(), static_cast<std::int32_t>(t)), 1);
      EXPECT_TRUE(std::is_sorted(round_tail.begin(), round_tail.end()));
    }
  }
}

}  // namespace
}  // namespace lmdbench
