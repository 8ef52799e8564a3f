// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/minimum_distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lmdbench {

namespace {

struct NearPair {
  double lower_bound;  ///< distance of the spheres
  std::int32_t index_a;
  std::int32_t index_b;
};

/// Visits the triangle pairs whose spheres are within `best`, which the visitor may lower.
/// @param visit  takes a NearestPair of one triangle pair; false ends the descent
template <typename Visit>
void descend(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
             const Hierarchy& fixed_hierarchy, const Pose& X_WM, const double& best, const Visit& visit) {
  if (moving_hierarchy.nodes.empty() || fixed_hierarchy.nodes.empty()) return;
  const RigidTransform transform(X_WM);

  const auto candidate = [&](std::int32_t index_a, std::int32_t index_b) {
    const HierarchyNode& a = moving_hierarchy.nodes[static_cast<std::size_t>(index_a)];
    const HierarchyNode& b = fixed_hierarchy.nodes[static_cast<std::size_t>(index_b)];
    const double gap = (b.centre - transform.point(a.centre)).norm() - a.radius - b.radius;
    return NearPair{std::max(0.0, gap), index_a, index_b};
  };

  // Depth first, the nearer child pair on top: the bound tightens early and the stack stays small.
  std::vector<NearPair> stack{candidate(0, 0)};
  std::array<NearPair, 2> children;
  while (!stack.empty()) {
    const NearPair pair = stack.back();
    stack.pop_back();
    if (pair.lower_bound > best) continue;
    const HierarchyNode& a = moving_hierarchy.nodes[static_cast<std::size_t>(pair.index_a)];
    const HierarchyNode& b = fixed_hierarchy.nodes[static_cast<std::size_t>(pair.index_b)];
    if (a.is_leaf() && b.is_leaf()) {
      const TrianglePairDistance distance = triangle_distance(
          transform.triangle(moving.mesh.triangle(a.triangle)), fixed.mesh.triangle(b.triangle));
      if (!visit(NearestPair{std::sqrt(distance.squared_distance), a.triangle, b.triangle, distance})) return;
      continue;
    }
    if (!a.is_leaf() && (b.is_leaf() || a.radius >= b.radius)) {
      children = {candidate(a.first_child, pair.index_b), candidate(a.first_child + 1, pair.index_b)};
    } else {
      children = {candidate(pair.index_a, b.first_child), candidate(pair.index_a, b.first_child + 1)};
    }
    if (children[0].lower_bound < children[1].lower_bound) std::swap(children[0], children[1]);
    for (const NearPair& child : children)
      if (child.lower_bound <= best) stack.push_back(child);
  }
}

}  // namespace

NearestPair nearest_pair(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                         const Hierarchy& fixed_hierarchy, const Pose& X_WM, double upper_bound) {
  NearestPair nearest;
  double best = upper_bound;
  descend(moving, moving_hierarchy, fixed, fixed_hierarchy, X_WM, best, [&](const NearestPair& pair) {
    if (pair.distance < best || (pair.distance <= best && nearest.triangle_moving < 0)) {
      best = pair.distance;
      nearest = pair;
    }
    return true;
  });
  return nearest;
}

bool within_distance(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                     const Hierarchy& fixed_hierarchy, const Pose& X_WM, double distance) {
  bool found = false;
  descend(moving, moving_hierarchy, fixed, fixed_hierarchy, X_WM, distance, [&](const NearestPair& pair) {
    found = pair.distance <= distance;
    return !found;
  });
  return found;
}

}  // namespace lmdbench
