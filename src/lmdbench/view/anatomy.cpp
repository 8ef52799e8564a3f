// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/cone.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/methods/original/face_neighbours.h>
#include <lmdbench/snch/traversal.h>
#include <lmdbench/view/anatomy.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace lmdbench {
namespace {

void collect_triangles(const Hierarchy& hierarchy, std::int32_t index, std::vector<std::int32_t>& triangles) {
  const HierarchyNode& node = hierarchy.nodes[static_cast<std::size_t>(index)];
  if (node.is_leaf()) {
    triangles.push_back(node.triangle);
    return;
  }
  collect_triangles(hierarchy, node.first_child, triangles);
  collect_triangles(hierarchy, node.first_child + 1, triangles);
}

void collect_level(const Hierarchy& hierarchy, std::int32_t index, int level,
                   std::vector<NodePatch>& patches) {
  const HierarchyNode& node = hierarchy.nodes[static_cast<std::size_t>(index)];
  if (level > 0 && !node.is_leaf()) {
    collect_level(hierarchy, node.first_child, level - 1, patches);
    collect_level(hierarchy, node.first_child + 1, level - 1, patches);
    return;
  }
  NodePatch patch{index, {}};
  collect_triangles(hierarchy, index, patch.triangles);
  std::sort(patch.triangles.begin(), patch.triangles.end());
  patches.push_back(std::move(patch));
}

NodeTestCase described(NodeVerdict verdict, const WorldNode& a, const HierarchyNode& b) {
  NodeTestCase result;
  result.verdict = verdict;
  const NodePair pair(a, b);
  result.centre_distance = std::sqrt(pair.squared_distance);
  result.cone_angle = std::numbers::pi - angle_between(a.cone_axis, b.cone_axis);
  if (pair.radii < result.centre_distance) result.sigma = std::asin(pair.radii / result.centre_distance);
  result.angle_moving = angle_between(pair.centres, a.cone_axis);
  result.angle_fixed = angle_between(-pair.centres, b.cone_axis);
  return result;
}

}  // namespace

std::vector<NodePatch> hierarchy_level(const Hierarchy& hierarchy, int level) {
  std::vector<NodePatch> patches;
  if (!hierarchy.nodes.empty()) collect_level(hierarchy, 0, level, patches);
  return patches;
}

std::string_view to_string(NodeVerdict verdict) {
  constexpr std::array<std::string_view, 4> NAMES{"rejected by G1", "rejected by G2", "rejected by G3",
                                                  "accepted"};
  return NAMES[static_cast<std::size_t>(verdict)];
}

NodeVerdict node_verdict(const WorldNode& moving, const HierarchyNode& fixed, double cutoff) {
  const NodePair pair(moving, fixed);
  if (rejected_by_cutoff(pair, cutoff)) return NodeVerdict::REJECTED_G1;
  if (rejected_by_collinearity(moving, fixed)) return NodeVerdict::REJECTED_G2;
  if (rejected_by_g3<DirectionTest::RAY>(moving, fixed, pair)) return NodeVerdict::REJECTED_G3;
  return NodeVerdict::ACCEPTED;
}

std::vector<NodeTestCase> node_test_cases(const Scene& scene, const Pose& X_WM, int level) {
  const Hierarchy& moving = scene.moving->prepared<Hierarchy>();
  const Hierarchy& fixed = scene.fixed.front()->prepared<Hierarchy>();
  const RigidTransform transform(X_WM);
  const std::vector<NodePatch> patches_moving = hierarchy_level(moving, level);
  const std::vector<NodePatch> patches_fixed = hierarchy_level(fixed, level);
  std::array<std::optional<NodeTestCase>, 4> nearest;
  for (const NodePatch& a : patches_moving) {
    const WorldNode world(moving.nodes[static_cast<std::size_t>(a.node)], transform);
    for (const NodePatch& b : patches_fixed) {
      const HierarchyNode& node = fixed.nodes[static_cast<std::size_t>(b.node)];
      const NodePair pair(world, node);
      if (pair.squared_distance <= pair.radii * pair.radii) continue;
      const NodeVerdict verdict = node_verdict(world, node, scene.cutoff);
      std::optional<NodeTestCase>& best = nearest[static_cast<std::size_t>(verdict)];
      if (best && best->centre_distance * best->centre_distance <= pair.squared_distance) continue;
      best = described(verdict, world, node);
      best->moving.node = a.node;
      best->fixed.node = b.node;
    }
  }
  std::vector<NodeTestCase> cases;
  for (std::optional<NodeTestCase>& found : nearest) {
    if (!found) continue;
    const auto with_triangles = [](const std::vector<NodePatch>& patches, std::int32_t node) {
      return *std::find_if(patches.begin(), patches.end(),
                           [&](const NodePatch& patch) { return patch.node == node; });
    };
    found->moving = with_triangles(patches_moving, found->moving.node);
    found->fixed = with_triangles(patches_fixed, found->fixed.node);
    cases.push_back(std::move(*found));
  }
  return cases;
}

std::vector<Neighbourhood> neighbourhoods(const Surface& surface, std::int32_t triangle) {
  const auto t = static_cast<std::size_t>(triangle);
  const FeatureId face{FeatureKind::FACE, triangle};
  const auto listed = [](const FeatureId& feature, const char* reading, const TriangleList& triangles) {
    return Neighbourhood{feature, reading, {triangles.begin(), triangles.end()}};
  };
  std::vector<Neighbourhood> all;
  for (const FeatureId& feature : {face, FeatureId{FeatureKind::EDGE, surface.adjacency.triangle_edges[t][0]},
                                   FeatureId{FeatureKind::VERTEX, surface.mesh.triangles[t][0]}})
    all.push_back(listed(feature, "incident", surface.incident_triangles(feature)));
  const FaceNeighbours wider(surface);
  all.insert(all.begin() + 1, listed(face, "edge neighbours", wider.of(triangle)));
  return all;
}

std::vector<SightCase> sight_cases(const Scene& scene, const Pose& X_WM) {
  const Surface& moving = scene.moving->surface();
  const Surface& fixed = scene.fixed.front()->surface();
  const RigidTransform transform(X_WM);
  std::array<std::optional<SightCase>, 2> nearest;  // culled, seen
  DualTraversal().run<DirectionTest::RAY>(
      scene.moving->prepared<Hierarchy>(), scene.fixed.front()->prepared<Hierarchy>(), transform,
      scene.cutoff, [&](std::int32_t t_moving, std::int32_t t_fixed) {
        SightCase here;
        here.triangle_moving = t_moving;
        here.triangle_fixed = t_fixed;
        here.moving = to_world(shaded_triangle(moving, t_moving), transform);
        here.fixed = shaded_triangle(fixed, t_fixed);
        here.sees = see_each_other(here.moving, here.fixed, Visibility::VERTEX_NORMAL);
        here.distance =
            std::sqrt(triangle_distance(here.moving.corners, here.fixed.corners).squared_distance);
        if (here.distance > scene.cutoff) return;
        std::optional<SightCase>& best = nearest[here.sees ? 1 : 0];
        if (!best || here.distance < best->distance) best = here;
      });
  std::vector<SightCase> cases;
  for (std::optional<SightCase>& found : {std::ref(nearest[1]), std::ref(nearest[0])}) {
    if (!found) continue;
    found->moving_on_fixed = sight(found->moving, found->fixed);
    found->fixed_on_moving = sight(found->fixed, found->moving);
    cases.push_back(*found);
  }
  return cases;
}

}  // namespace lmdbench
