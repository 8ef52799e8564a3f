// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/critical/surface_samples.h>
#include <lmdbench/decision/critical_index.h>
#include <lmdbench/geometry/triangle_sides.h>
#include <lmdbench/shape/shape_complex.h>
#include <lmdbench/snch/minimum_distance.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace lmdbench {

namespace {

struct PatchBall {
  Vec3 centre;
  double radius;
};

/// Round the middle of a triangle.
PatchBall ball_of(const Triangle& t) {
  const Vec3 centre = (t[0] + t[1] + t[2]) / 3.0;
  double radius = 0.0;
  for (const Vec3& corner : t) radius = std::max(radius, (corner - centre).norm());
  return {centre, radius};
}

}  // namespace

/// On one fixed mesh.
struct SurfaceSampler::Search {
  const RigidTransform &X_WM, &generic;  ///< ..., and where indices are taken.
  const CriticalSet& critical;
  MergeFinder& descents;
  const Surface &moving, &fixed;
  const Hierarchy &moving_hierarchy, &fixed_hierarchy;
  const std::int32_t body;
  const double cutoff, longest_patch_edge;
  std::vector<SurfaceSample>& samples;
  std::size_t first_basin = MergeFinder::NO_MINIMUM;
  double one_from = 0.0;  ///< Level from which all minima on this mesh are in one component.

  NearestPoint nearest(const Vec3& p_W, double bound) const {
    return nearest_point(fixed, fixed_hierarchy, p_W, bound);
  }

  /// Minima and the level at which they are one; false where there is nothing to sample.
  bool look_at_minima(std::span<const Merge> merges) {
    std::vector<std::size_t> group(critical.size());
    std::size_t groups = 0;
    for (std::size_t i = 0; i < critical.size(); ++i) {
      group[i] = i;
      const CriticalPair& c = critical[i];
      if (c.pair.fixed_body != body) continue;
      if (c.pair.intersecting || !(c.pair.distance > 0.0)) return false;
      if (!c.is_basin) continue;
      ++groups;
      if (first_basin == MergeFinder::NO_MINIMUM) first_basin = i;
    }
    if (groups == 0) return false;
    if (groups > 1) one_from = std::numeric_limits<double>::infinity();
    for (const Merge& merge : merges) {
      const std::size_t from = group[merge.first], to = group[merge.second];
      if (from == to || critical[merge.saddle].pair.fixed_body != body) continue;
      std::ranges::replace(group, from, to);
      if (--groups == 1) one_from = critical[merge.saddle].pair.distance;
    }
    return true;
  }

  void node(std::int32_t index) {
    const HierarchyNode& at = moving_hierarchy.nodes[static_cast<std::size_t>(index)];
    if (at.is_leaf()) {
      const Vec3 normal = X_WM.rotation * moving.face_normals[static_cast<std::size_t>(at.triangle)];
      if (!normal.isZero(0.0)) patch(at.triangle, X_WM.triangle(moving.mesh.triangle(at.triangle)), normal);
      return;
    }
    if (nearest(X_WM.point(at.centre), cutoff + at.radius).triangle < 0) return;
    node(at.first_child);
    node(at.first_child + 1);
  }

  void patch(std::int32_t triangle, const Triangle& t, const Vec3& normal) {
    const bool is_small = longest_side(t) <= longest_patch_edge;
    const PatchBall ball = ball_of(t);
    const NearestPoint found = nearest(ball.centre, is_small ? cutoff : cutoff + ball.radius);
    if (found.triangle < 0) return;
    if (!is_small) {
      const Vec3 a = 0.5 * (t[0] + t[1]), b = 0.5 * (t[1] + t[2]), c = 0.5 * (t[2] + t[0]);
      for (const Triangle& part :
           {Triangle{t[0], a, c}, Triangle{a, t[1], b}, Triangle{c, b, t[2]}, Triangle{a, b, c}})
        patch(triangle, part, normal);
      return;
    }
    SurfaceSample sample;
    sample.distance = found.distance;
    if (!(sample.distance > 0.0)) return;
    sample.direction = (found.place.point - ball.centre) / sample.distance;
    // Seen along the direction: no jump where a side turns away; sides beyond the solid have none.
    const double seen = sample.direction.dot(normal);
    if (!(seen > 0.0)) return;
    sample.area = seen * 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
    sample.point_moving = ball.centre;
    sample.minimum = sample.distance >= one_from
                         ? first_basin
                         : descents.end_of_descent(generic, critical, body, triangle, found.triangle);
    if (sample.minimum != MergeFinder::NO_MINIMUM) samples.push_back(sample);
  }
};

void SurfaceSampler::find(const Pose& X_WM, const CriticalSet& critical, std::span<const Merge> merges,
                          MergeFinder& descents, std::vector<SurfaceSample>& samples) {
  samples.clear();
  const auto& moving_hierarchy = scene_.moving->prepared<Hierarchy>();
  if (moving_hierarchy.nodes.empty()) return;
  const RigidTransform at(X_WM),
      generic = generic_pose(at, scene_.moving->prepared<ShapeComplex>().regions.extent);
  for (std::int32_t body = 0; body < static_cast<std::int32_t>(scene_.fixed.size()); ++body) {
    const Body& fixed = *scene_.fixed[static_cast<std::size_t>(body)];
    Search search{at,
                  generic,
                  critical,
                  descents,
                  scene_.moving->surface(),
                  fixed.surface(),
                  moving_hierarchy,
                  fixed.prepared<Hierarchy>(),
                  body,
                  scene_.cutoff,
                  longest_edge_,
                  samples};
    if (search.look_at_minima(merges)) search.node(0);
  }
}

}  // namespace lmdbench
