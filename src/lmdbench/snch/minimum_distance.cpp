// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/snch/minimum_distance.h>
#include <lmdbench/snch/slab_distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
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
  LMDBENCH_EXPECTS(!std::isnan(best), "a bound that is not a number would reject everything");
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
      const Triangle on_moving = transform.triangle(moving.mesh.triangle(a.triangle)),
                     on_fixed = fixed.mesh.triangle(b.triangle);
      const auto apart = [&, extent = pair.lower_bound + 2.0 * (a.radius + b.radius)](const Vec3& normal) {
        const SlabGaps gaps = slab_gaps(normal, on_moving, on_fixed, extent);
        return std::max(gaps.a_above_b, gaps.b_above_a) > best;
      };
      if (apart(fixed.face_normals[static_cast<std::size_t>(b.triangle)]) ||
          apart(transform.direction(moving.face_normals[static_cast<std::size_t>(a.triangle)])))
        continue;
      const TrianglePairDistance distance = triangle_distance(on_moving, on_fixed);
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

NearestPair NearestTracker::last_pair(const Pose& X_WM) const {
  if (last_moving_ < 0) return {};
  LMDBENCH_EXPECTS(static_cast<std::size_t>(last_moving_) < moving_.mesh.triangles.size() &&
                       static_cast<std::size_t>(last_fixed_) < fixed_.mesh.triangles.size(),
                   "a tracker that outlives its meshes");
  const Triangle triangle_W = RigidTransform(X_WM).triangle(moving_.mesh.triangle(last_moving_));
  const TrianglePairDistance pair = triangle_distance(triangle_W, fixed_.mesh.triangle(last_fixed_));
  return {std::sqrt(pair.squared_distance), last_moving_, last_fixed_, pair};
}

NearestPair NearestTracker::nearest(const Pose& X_WM) {
  NearestPair last = last_pair(X_WM);
  const double bound = last.triangle_moving < 0 ? std::numeric_limits<double>::infinity() : last.distance;
  NearestPair found = nearest_pair(moving_, moving_hierarchy_, fixed_, fixed_hierarchy_, X_WM, bound);
  if (found.triangle_moving < 0) return last;  // nothing is nearer
  last_moving_ = found.triangle_moving;
  last_fixed_ = found.triangle_fixed;
  return found;
}

NearestPoint nearest_point(const Surface& surface, const Hierarchy& hierarchy, const Vec3& p_M,
                           double upper_bound) {
  NearestPoint nearest;
  if (hierarchy.nodes.empty()) return nearest;
  LMDBENCH_EXPECTS(p_M.allFinite() && !std::isnan(upper_bound), "a point or bound that was never set");
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
