// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/snch/first_approach.h>
#include <lmdbench/snch/slab_distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lmdbench {

namespace {

constexpr double NEVER = -std::numeric_limits<double>::infinity();

/// Newton's steps at a double crossing halve the remaining distance: so many leave nothing.
constexpr int MAXIMUM_STEPS = 100;

/// Relative rounding error by which a sphere's crossing may be too near.
constexpr double ROUNDING = 1e-12;

struct MeetingPair {
  double upper_bound;  ///< First crossing of the spheres.
  std::int32_t index_a;
  std::int32_t index_b;
};

class ApproachSearch {
 public:
  ApproachSearch(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                 const Hierarchy& fixed_hierarchy, const Pose& X_WM, const Vec3& direction_W, double gap,
                 double tolerance)
      : moving_(moving),
        moving_hierarchy_(moving_hierarchy),
        fixed_(fixed),
        fixed_hierarchy_(fixed_hierarchy),
        transform_(X_WM),
        direction_(direction_W),
        gap_(gap),
        enough_(gap * (1.0 + tolerance)) {
    if (moving_hierarchy_.nodes.empty() || fixed_hierarchy_.nodes.empty()) return;
    const HierarchyNode &a = moving_hierarchy_.nodes.front(), &b = fixed_hierarchy_.nodes.front();
    extent_ = (transform_.point(a.centre) - b.centre).norm() + 2.0 * (a.radius + b.radius);
  }

  FirstApproach run(const FirstApproach& begin) {
    if (moving_hierarchy_.nodes.empty() || fixed_hierarchy_.nodes.empty()) return best_;
    if (begin.triangle_moving >= 0) {
      const double start = candidate(0, 0).upper_bound;
      if (start > NEVER) try_pair(begin.triangle_moving, begin.triangle_fixed, start);
    }
    // Depth first, the child pair with the earlier bound on top, as in `nearest_pair`.
    std::vector<MeetingPair> stack{candidate(0, 0)};
    while (!stack.empty()) {
      const MeetingPair pair = stack.back();
      stack.pop_back();
      if (!(pair.upper_bound > best_.displacement)) continue;
      const HierarchyNode& a = moving_hierarchy_.nodes[static_cast<std::size_t>(pair.index_a)];
      const HierarchyNode& b = fixed_hierarchy_.nodes[static_cast<std::size_t>(pair.index_b)];
      if (a.is_leaf() && b.is_leaf()) {
        try_pair(a.triangle, b.triangle, pair.upper_bound);
        continue;
      }
      const bool split_a = !a.is_leaf() && (b.is_leaf() || a.radius >= b.radius);
      std::array<MeetingPair, 2> children = split_a ? std::array{candidate(a.first_child, pair.index_b),
                                                                 candidate(a.first_child + 1, pair.index_b)}
                                                    : std::array{candidate(pair.index_a, b.first_child),
                                                                 candidate(pair.index_a, b.first_child + 1)};
      if (children[0].upper_bound > children[1].upper_bound) std::swap(children[0], children[1]);
      for (const MeetingPair& child : children)
        if (child.upper_bound > best_.displacement) stack.push_back(child);
    }
    return best_;
  }

 private:
  MeetingPair candidate(std::int32_t index_a, std::int32_t index_b) const {
    const HierarchyNode& a = moving_hierarchy_.nodes[static_cast<std::size_t>(index_a)];
    const HierarchyNode& b = fixed_hierarchy_.nodes[static_cast<std::size_t>(index_b)];
    const Vec3 between = transform_.point(a.centre) - b.centre;
    const double along = between.dot(direction_);
    const double sum = a.radius + b.radius + gap_;
    const double slack = ROUNDING * (sum + between.norm());
    const double wide = sum + slack;
    const double inside = wide * wide - (between - along * direction_).squaredNorm();
    if (!(inside >= 0.0)) return {NEVER, index_a, index_b};
    return {std::sqrt(inside) - along + slack, index_a, index_b};
  }

  /// Whether slabs on an axis, at the best displacement, are beyond the gap and from there on.
  bool is_beyond(const Vec3& axis, const Triangle& a, const Triangle& b) const {
    const Vec3 way = best_.displacement * direction_;
    const double extent = extent_ + std::abs(best_.displacement);
    const SlabGaps gaps = slab_gaps(axis, {a[0] + way, a[1] + way, a[2] + way}, b, extent);
    return (axis.dot(direction_) >= 0.0 ? gaps.a_above_b : gaps.b_above_a) > enough_;
  }

  /// @param s  there, and everywhere beyond, the pair's distance is at least the gap
  void try_pair(std::int32_t triangle_moving, std::int32_t triangle_fixed, double s) {
    const Triangle a = transform_.triangle(moving_.mesh.triangle(triangle_moving));
    const Triangle b = fixed_.mesh.triangle(triangle_fixed);
    if (best_.displacement > NEVER &&
        (is_beyond(fixed_.face_normals[static_cast<std::size_t>(triangle_fixed)], a, b) ||
         is_beyond(transform_.direction(moving_.face_normals[static_cast<std::size_t>(triangle_moving)]), a,
                   b)))
      return;
    for (int step = 0; step < MAXIMUM_STEPS && s > best_.displacement; ++step) {
      const Vec3 way = s * direction_;
      const TrianglePairDistance pair = triangle_distance(Triangle{a[0] + way, a[1] + way, a[2] + way}, b);
      const double distance = std::sqrt(pair.squared_distance);
      if (distance <= enough_) {
        best_ = {s, triangle_moving, triangle_fixed};
        return;
      }
      const double slope = (pair.point_a - pair.point_b).dot(direction_) / distance;
      if (!(slope > 0.0)) return;  // convex: only farther from here
      s -= (distance - gap_) / slope;
    }
  }

  const Surface& moving_;
  const Hierarchy& moving_hierarchy_;
  const Surface& fixed_;
  const Hierarchy& fixed_hierarchy_;
  RigidTransform transform_;
  Vec3 direction_;
  double gap_;
  double enough_;
  double extent_ = 0.0;  ///< Bound of corner distances at X_WM [m].
  FirstApproach best_;
};

}  // namespace

FirstApproach first_approach(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                             const Hierarchy& fixed_hierarchy, const Pose& X_WM, const Vec3& direction_W,
                             double gap, double tolerance, const FirstApproach& begin) {
  LMDBENCH_EXPECTS(gap > 0.0 && tolerance > 0.0, "a gap that no step can reach");
  LMDBENCH_EXPECTS(is_unit(direction_W), "a direction that was not normalised");
  return ApproachSearch(moving, moving_hierarchy, fixed, fixed_hierarchy, X_WM, direction_W, gap, tolerance)
      .run(begin);
}

}  // namespace lmdbench
