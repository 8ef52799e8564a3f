// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/exhaustive/exhaustive.h>
#include <lmdbench/snch/hierarchy.h>
#include <lmdbench/snch/node_tests.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

constexpr auto *by_ray = rejected_by_g3<DirectionTest::RAY>, *by_line = rejected_by_g3<DirectionTest::LINE>,
               *by_literal = rejected_by_g3<DirectionTest::LITERAL>,
               *by_clamped = rejected_by_g3<DirectionTest::CLAMPED>;

using testing::grazing_pose;
using testing::make_scene;

std::vector<TriangleMesh> shapes() {
  return {make_sphere(0.05, 2),        make_torus(0.05, 0.02, 24, 12), make_blob(0.05, 0.01, 3),
          make_unequal(0.05, 6, 50.0), make_needles(0.05, 0.1, 12),    make_patch(0.1, 8, 0.01),
          make_l_block(0.05),          make_box({0.1, 0.05, 0.02}, 3)};
}

/// Calls `visit` with every node and its chain of ancestors, root first, the node last.
void for_each_node(const Hierarchy& hierarchy,
                   const std::function<void(const std::vector<const HierarchyNode*>&)>& visit) {
  std::vector<const HierarchyNode*> chain;
  const std::function<void(std::int32_t)> descend = [&](std::int32_t index) {
    const HierarchyNode& node = hierarchy.nodes[static_cast<std::size_t>(index)];
    chain.push_back(&node);
    visit(chain);
    if (!node.is_leaf()) {
      descend(node.first_child);
      descend(node.first_child + 1);
    }
    chain.pop_back();
  };
  descend(0);
}

TEST(Hierarchy, EveryTriangleIsOneLeafInsideTheSpheresAboveIt) {
  for (const TriangleMesh& mesh : shapes()) {
    const Surface surface = build_surface(mesh);
    const Hierarchy hierarchy = Hierarchy::of(surface);
    ASSERT_EQ(hierarchy.nodes.size(), 2 * mesh.triangles.size() - 1);
    std::vector<int> seen(mesh.triangles.size(), 0);
    for_each_node(hierarchy, [&](const std::vector<const HierarchyNode*>& chain) {
      if (!chain.back()->is_leaf()) return;
      ++seen[static_cast<std::size_t>(chain.back()->triangle)];
      for (const HierarchyNode* node : chain)
        for (const Vec3& corner : mesh.triangle(chain.back()->triangle))
          EXPECT_LE((corner - node->centre).norm(), node->radius * (1.0 + 1e-12));
    });
    EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int count) { return count == 1; }));
  }
}

TEST(Hierarchy, ConesHoldTheNormalsRoundEveryLeafBelow) {
  for (const TriangleMesh& mesh : shapes()) {
    const Surface surface = build_surface(mesh);
    for_each_node(Hierarchy::of(surface), [&](const std::vector<const HierarchyNode*>& chain) {
      if (!chain.back()->is_leaf()) return;
      for (const std::int32_t corner : mesh.triangles[static_cast<std::size_t>(chain.back()->triangle)])
        for (const std::int32_t t : surface.adjacency.vertex_triangles[corner])
          for (const HierarchyNode* node : chain)
            EXPECT_GE(node->cone_axis.dot(surface.face_normals[static_cast<std::size_t>(t)]),
                      node->cone_cosine - 1e-12);
    });
  }
}

TEST(Hierarchy, LeafConesOfABoundaryAreAllDirections) {
  const Surface surface = build_surface(make_patch(0.1, 4, 0.0));
  int all_directions = 0, narrow = 0;
  for (const HierarchyNode& node : Hierarchy::of(surface).nodes) {
    if (!node.is_leaf()) continue;
    const auto& corners = surface.mesh.triangles[static_cast<std::size_t>(node.triangle)];
    const bool at_boundary = std::any_of(corners.begin(), corners.end(), [&](std::int32_t v) {
      return surface.vertex_is_boundary[static_cast<std::size_t>(v)];
    });
    EXPECT_EQ(at_boundary, node.cone_cosine == -1.0);
    ++(at_boundary ? all_directions : narrow);
  }
  EXPECT_GT(all_directions, 0);
  EXPECT_GT(narrow, 0);
}

TEST(Hierarchy, IsTheSameEachTime) {
  const Surface surface = build_surface(make_blob(0.05, 0.01, 3));
  const Hierarchy first = Hierarchy::of(surface), second = Hierarchy::of(surface);
  ASSERT_EQ(first.nodes.size(), second.nodes.size());
  for (std::size_t i = 0; i < first.nodes.size(); ++i) {
    EXPECT_EQ(first.nodes[i].centre, second.nodes[i].centre);
    EXPECT_EQ(first.nodes[i].radius, second.nodes[i].radius);
    EXPECT_EQ(first.nodes[i].cone_axis, second.nodes[i].cone_axis);
    EXPECT_EQ(first.nodes[i].triangle, second.nodes[i].triangle);
  }
}

/// Chain of nodes from the root to the leaf of each triangle.
std::map<std::int32_t, std::vector<const HierarchyNode*>> chains_to_leaves(const Hierarchy& hierarchy) {
  std::map<std::int32_t, std::vector<const HierarchyNode*>> chains;
  for_each_node(hierarchy, [&](const std::vector<const HierarchyNode*>& chain) {
    if (chain.back()->is_leaf()) chains[chain.back()->triangle] = chain;
  });
  return chains;
}

/// True LMDs must pass the tests of all pairs of nodes above them. Decision E2: the printed
/// inequality of G3 rejects them if taken literally.
TEST(NodeTests, KeepEveryTrueLmd) {
  std::mt19937_64 random(7);
  std::int64_t lmd_count = 0, lost_by_literal_g3 = 0;
  for (const TriangleMesh& mesh : shapes()) {
    // Far apart: spheres of leaves that overlap would pass every reading of G3.
    const Scene scene = make_scene(make_blob(0.04, 0.008, 3), mesh, 0.04);
    Exhaustive exhaustive(scene);
    const auto chains_moving = chains_to_leaves(scene.moving->prepared<Hierarchy>());
    const auto chains_fixed = chains_to_leaves(scene.fixed[0]->prepared<Hierarchy>());
    for (int sample = 0; sample < 12; ++sample) {
      const Pose pose = grazing_pose(scene, 0.02, random);
      const RigidTransform transform(pose);
      const LmdSet lmds = lmds_at(exhaustive, pose);
      for (const Lmd& lmd : lmds) {
        ++lmd_count;
        bool literal_keeps = true;
        for (const HierarchyNode* a : chains_moving.at(lmd.triangle_moving)) {
          const WorldNode world_a(*a, transform);
          for (const HierarchyNode* b : chains_fixed.at(lmd.triangle_fixed)) {
            const NodePair pair(world_a, *b);
            EXPECT_FALSE(rejected_by_cutoff(pair, scene.cutoff));
            EXPECT_FALSE(rejected_by_collinearity(world_a, *b));
            EXPECT_FALSE(by_ray(world_a, *b, pair));
            EXPECT_FALSE(by_line(world_a, *b, pair));
            literal_keeps = literal_keeps && !by_literal(world_a, *b, pair);
          }
        }
        if (!literal_keeps) ++lost_by_literal_g3;
      }
    }
  }
  EXPECT_GT(lmd_count, 100);
  EXPECT_GT(lost_by_literal_g3, lmd_count / 2);
}

TEST(NodeTests, AgreeWithTheAnglesOfThePaper) {
  std::mt19937_64 random(11);
  int rejected_g2 = 0, rejected_g3 = 0;
  for (int i = 0; i < 20000; ++i) {
    WorldNode a;
    HierarchyNode b{};
    const double phi_a = 1.6 * testing::uniform(random), phi_b = 1.6 * testing::uniform(random);
    a.centre = testing::random_direction(random);
    b.centre = 3.0 * testing::random_direction(random);
    a.radius = 0.7 * testing::uniform(random);
    b.radius = 0.7 * testing::uniform(random);
    a.cone_axis = testing::random_direction(random);
    b.cone_axis = testing::random_direction(random);
    a.cone_cosine = std::cos(phi_a), a.cone_sine = std::sin(phi_a);
    b.cone_cosine = std::cos(phi_b), b.cone_sine = std::sin(phi_b);
    const NodePair pair(a, b);
    const Vec3 line = (b.centre - a.centre).normalized();
    const double sigma = std::asin(pair.radii / (b.centre - a.centre).norm());
    const bool g2 = std::numbers::pi - std::acos(a.cone_axis.dot(b.cone_axis)) > phi_a + phi_b;
    const bool g3 =
        std::acos(line.dot(a.cone_axis)) > sigma + phi_a || std::acos(-line.dot(b.cone_axis)) > sigma + phi_b;
    EXPECT_EQ(rejected_by_collinearity(a, b), g2);
    EXPECT_EQ(by_ray(a, b, pair), g3);
    rejected_g2 += g2;
    rejected_g3 += g3;
  }
  EXPECT_GT(rejected_g2, 1000);
  EXPECT_GT(rejected_g3, 1000);
}

/// Decision E1: the more faces a leaf's cone covers, the wider it is; only the widest loses no LMD.
TEST(LeafCones, TheNarrowerOnesLoseLmds) {
  std::mt19937_64 random(3);
  const Scene scene = make_scene(make_blob(0.04, 0.008, 3), make_torus(0.05, 0.02, 24, 12), 0.04);
  const Surface& surface = scene.moving->surface();
  std::vector<double> widths;
  std::vector<std::int64_t> lost;
  for (const LeafCones cones : {LeafCones::OWN, LeafCones::EDGE_NEIGHBOURS, LeafCones::ONE_RING}) {
    const Hierarchy moving = hierarchy_with(surface, cones);
    const Hierarchy fixed = hierarchy_with(scene.fixed[0]->surface(), cones);
    EXPECT_EQ(prepared_hierarchy(*scene.moving, cones).nodes[0].cone_cosine, moving.nodes[0].cone_cosine);
    const auto leaves_moving = chains_to_leaves(moving), leaves_fixed = chains_to_leaves(fixed);
    double width = 0.0;
    for (const auto& [triangle, chain] : leaves_moving) {
      const HierarchyNode& leaf = *chain.back();
      const Vec3& normal = surface.face_normals[static_cast<std::size_t>(triangle)];
      EXPECT_GE(leaf.cone_axis.dot(normal), leaf.cone_cosine - 1e-12);
      width += std::acos(leaf.cone_cosine);
    }
    widths.push_back(width);
    Exhaustive exhaustive(scene);
    std::mt19937_64 same = random;
    lost.push_back(0);
    for (int sample = 0; sample < 10; ++sample) {
      const Pose pose = grazing_pose(scene, 0.02, same);
      const LmdSet lmds = lmds_at(exhaustive, pose);
      for (const Lmd& lmd : lmds) {
        const WorldNode a(*leaves_moving.at(lmd.triangle_moving).back(), RigidTransform(pose));
        const HierarchyNode& b = *leaves_fixed.at(lmd.triangle_fixed).back();
        lost.back() += rejected_by_collinearity(a, b) || by_ray(a, b, NodePair(a, b)) ? 1 : 0;
      }
    }
  }
  EXPECT_LT(widths[0], 0.5 * widths[1]);
  EXPECT_LT(widths[1], 0.95 * widths[2]);
  EXPECT_GT(lost[0], lost[1]);
  EXPECT_EQ(lost[2], 0);
}

/// Decision E3: sigma is undefined where the spheres overlap.
TEST(NodeTests, OverlappingSpheresPassG3) {
  WorldNode a;
  HierarchyNode b{};
  a.centre = Vec3::Zero();
  b.centre = Vec3(0.5, 0.0, 0.0);
  a.radius = b.radius = 0.3;
  a.cone_axis = -Vec3::UnitX();
  b.cone_axis = Vec3::UnitX();
  a.cone_cosine = b.cone_cosine = std::cos(0.1);
  a.cone_sine = b.cone_sine = std::sin(0.1);
  EXPECT_FALSE(by_ray(a, b, NodePair(a, b)));
  EXPECT_TRUE(by_clamped(a, b, NodePair(a, b))) << "the ablation takes 90 degrees for it";
  b.cone_axis = -Vec3::UnitX();
  EXPECT_TRUE(by_clamped(a, b, NodePair(a, b))) << "the moving one alone faces away";
  a.cone_axis = b.cone_axis = Vec3::UnitX();
  EXPECT_TRUE(by_clamped(a, b, NodePair(a, b))) << "the fixed one alone does";
  b.cone_axis = -Vec3::UnitX();
  EXPECT_FALSE(by_clamped(a, b, NodePair(a, b)));
  std::swap(a.cone_axis, b.cone_axis);
  a.radius = b.radius = 0.2;
  EXPECT_TRUE(by_ray(a, b, NodePair(a, b)));
  EXPECT_TRUE(by_clamped(a, b, NodePair(a, b)));
}

}  // namespace
}  // namespace lmdbench
