// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/nearest_point.h>

#include <cmath>
#include <utility>
#include <vector>

namespace lmdbench {

NearestPoint nearest_point(const Surface& surface, const Hierarchy& hierarchy, const Vec3& p_M,
                           double upper_bound) {
  NearestPoint nearest;
  if (hierarchy.nodes.empty()) return nearest;
  double best = upper_bound;
  const auto bound_of = [&](std::int32_t index) {
    const HierarchyNode& node = hierarchy.nodes[static_cast<std::size_t>(index)];
    return std::pair{(node.centre - p_M).norm() - node.radius, index};
  };
  // Depth first, the nearer child on top.
  std::vector<std::pair<double, std::int32_t>> stack{bound_of(0)};
  while (!stack.empty()) {
    const auto [bound, index] = stack.back();
    stack.pop_back();
    if (bound > best) continue;
    const HierarchyNode& node = hierarchy.nodes[static_cast<std::size_t>(index)];
    if (!node.is_leaf()) {
      auto left = bound_of(node.first_child), right = bound_of(node.first_child + 1);
      if (left.first < right.first) std::swap(left, right);
      if (left.first <= best) stack.push_back(left);
      if (right.first <= best) stack.push_back(right);
      continue;
    }
    const PointTriangleDistance found = point_triangle_distance(p_M, surface.mesh.triangle(node.triangle));
    const double distance = std::sqrt(found.squared_distance);
    if (!(distance < best || (distance <= best && nearest.triangle < 0))) continue;
    best = distance;
    nearest = {distance, node.triangle, found};
  }
  return nearest;
}

}  // namespace lmdbench
