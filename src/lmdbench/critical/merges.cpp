// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/critical/merges.h>
#include <lmdbench/decision/contact_tolerance.h>
#include <lmdbench/decision/critical_index.h>
#include <lmdbench/geometry/point_triangle.h>
#include <lmdbench/geometry/segment_distance.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/shape/shape_complex.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace lmdbench {

namespace {

/// Least cosine of the directions of a descent's end and of its minimum on other features.
constexpr double SAME_DESCENT_DIRECTION = 0.995;
/// Distances of a descent's end and its minimum differ by less than this part of the coordinates:
/// covers the turn of the generic pose and the accuracy of meshes.
constexpr double SAME_DESCENT_DISTANCE = 16.0 * LEAST_TOLERANCE;

/// Larger level places are given up.
constexpr std::size_t MOST_PAIRS_OF_A_PLACE = 4096;

double largest_coordinate_of(const Surface& surface) {
  double largest = 0.0;
  for (const Vec3& v : surface.mesh.vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  return largest;
}

/// Whether a triangle reaches farther along a direction than a point of it.
bool reaches(const Triangle& triangle, const Vec3& point, const Vec3& direction) {
  // Corners of the saddle's own feature are square to it: rounding.
  const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * direction.norm();
  return std::ranges::any_of(triangle, [&](const Vec3& corner) {
    return (corner - point).dot(direction) >
           rounding * (point.cwiseAbs().maxCoeff() + corner.cwiseAbs().maxCoeff());
  });
}

/// Triangles that share a corner with one, itself among them.
std::vector<std::int32_t> neighbours_of(const Surface& surface, std::int32_t triangle) {
  std::vector<std::int32_t> found;
  for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(triangle)])
    for (const std::int32_t t : surface.incident_triangles({FeatureKind::VERTEX, corner}))
      if (std::ranges::find(found, t) == found.end()) found.push_back(t);
  return found;
}

}  // namespace

std::size_t MergeFinder::end_of_descent(const RigidTransform& X_WM, const CriticalSet& critical,
                                        std::int32_t body, std::int32_t t_moving, std::int32_t t_fixed) {
  const Surface &moving = scene_.moving->surface(),
                &fixed = scene_.fixed[static_cast<std::size_t>(body)]->surface();
  const auto distance_of = [&](std::int32_t a, std::int32_t b) {
    ++triangle_distances_;
    return triangle_distance(X_WM.triangle(moving.mesh.triangle(a)), fixed.mesh.triangle(b));
  };
  // A place that is level but for the generic pose's turn, or next to a birth or death, may stop a
  // descent that goes on elsewhere: go over pairs at the same distance until one is nearer.
  const auto leave_level_place = [&](std::pair<std::int32_t, std::int32_t> from, double distance,
                                     double same) {
    std::vector<std::pair<std::int32_t, std::int32_t>> place{from};
    std::set<std::pair<std::int32_t, std::int32_t>> met{from};
    for (std::size_t k = 0; k < place.size() && place.size() < MOST_PAIRS_OF_A_PLACE; ++k) {
      const auto around = neighbours_of(moving, place[k].first),
                 others = neighbours_of(fixed, place[k].second);
      for (const std::int32_t s : around)
        for (const std::int32_t t : others) {
          if (!met.insert({s, t}).second) continue;
          const double there = std::sqrt(distance_of(s, t).squared_distance);
          if (there < distance - same) return end_of_descent(X_WM, critical, body, s, t);
          if (there <= distance + same) place.emplace_back(s, t);
        }
    }
    return NO_MINIMUM;
  };
  std::vector<std::pair<std::int32_t, std::int32_t>> way{{t_moving, t_fixed}};
  TrianglePairDistance here = distance_of(t_moving, t_fixed);
  std::size_t end = NO_MINIMUM;
  for (;;) {
    const auto [a, b] = way.back();
    if (const auto known = ended_.find({body, a, b}); known != ended_.end()) {
      end = known->second;
      break;
    }
    // The distance is convex on a pair of triangles: a minimum on it is its least. By names: next
    // to a birth, minimum and saddle are nearer than the kernel tells a face from its edge.
    for (std::size_t i = 0; i < critical.size() && end == NO_MINIMUM; ++i)
      if (critical[i].is_basin && critical[i].pair.fixed_body == body &&
          moving.incident_triangles(critical[i].pair.feature_moving).contains(a) &&
          fixed.incident_triangles(critical[i].pair.feature_fixed).contains(b))
        end = i;
    if (end != NO_MINIMUM) break;
    const FeatureId f = moving.feature_of(a, here.feature_a), g = fixed.feature_of(b, here.feature_b);
    std::pair<std::int32_t, std::int32_t> next{-1, -1};
    TrianglePairDistance there = here;
    for (const std::int32_t s : moving.incident_triangles(f))
      for (const std::int32_t t : fixed.incident_triangles(g)) {
        if (s == a && t == b) continue;
        const TrianglePairDistance found = distance_of(s, t);
        if (!(found.squared_distance < there.squared_distance)) continue;
        there = found;
        next = {s, t};
      }
    if (next.first >= 0) {
      here = there;
      way.push_back(next);
      continue;
    }
    const double distance = std::sqrt(here.squared_distance);
    const Vec3 direction = (here.point_b - here.point_a) / distance;
    const double same =
        SAME_DESCENT_DISTANCE * std::max(largest_coordinate_of(moving), largest_coordinate_of(fixed)) +
        moving.mesh.planar_tolerance + fixed.mesh.planar_tolerance;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < critical.size(); ++i) {
      const Lmd& lmd = critical[i].pair;
      if (!critical[i].is_basin || lmd.fixed_body != body || std::abs(lmd.distance - distance) > same)
        continue;
      const bool same_features = lmd.feature_moving == f && lmd.feature_fixed == g;
      if (!same_features && !(lmd.direction.dot(direction) > SAME_DESCENT_DIRECTION)) continue;
      const double apart = same_features ? -1.0 : (lmd.point_fixed - here.point_b).norm();
      if (apart >= nearest) continue;
      nearest = apart;
      end = i;
    }
    // Where meshes intersect everything is level.
    if (end == NO_MINIMUM && distance > same) end = leave_level_place(way.back(), distance, same);
    break;
  }
  for (const auto& [a, b] : way) ended_[{body, a, b}] = end;
  return end;
}

void MergeFinder::find(const Pose& pose, const CriticalSet& critical, std::vector<Merge>& merges) {
  LMDBENCH_EXPECTS(std::ranges::is_sorted(critical, lmd_less, &CriticalPair::pair),
                   "a set that was not sorted (sort_critical)");
  merges.clear();
  ended_.clear();
  const auto minima = std::ranges::count_if(critical, [](const CriticalPair& c) { return c.is_basin; });
  if (minima < 2) return;
  const RigidTransform X_WM =
      generic_pose(RigidTransform(pose), scene_.moving->prepared<ShapeComplex>().regions.extent);
  const Surface& moving = scene_.moving->surface();
  std::vector<std::size_t> ends;
  for (std::int32_t body = 0; body < static_cast<std::int32_t>(scene_.fixed.size()); ++body) {
    const Surface& fixed = scene_.fixed[static_cast<std::size_t>(body)]->surface();
    for (std::size_t i = 0; i < critical.size(); ++i) {
      const Lmd& saddle = critical[i].pair;
      if (critical[i].index > -1 || critical[i].is_minimum || saddle.fixed_body != body) continue;
      // The distance is convex on a pair of the saddle's triangles: it falls where one reaches
      // farther along its direction. Not by distances, which next to a birth differ by a square.
      const Vec3 d = saddle.distance * saddle.direction;
      ends.clear();
      for (const std::int32_t s : moving.incident_triangles(saddle.feature_moving))
        for (const std::int32_t t : fixed.incident_triangles(saddle.feature_fixed)) {
          if (!reaches(X_WM.triangle(moving.mesh.triangle(s)), saddle.point_moving, d) &&
              !reaches(fixed.mesh.triangle(t), saddle.point_fixed, -d))
            continue;
          const std::size_t end = end_of_descent(X_WM, critical, body, s, t);
          if (end != NO_MINIMUM && std::ranges::find(ends, end) == ends.end()) ends.push_back(end);
        }
      for (std::size_t k = 1; k < ends.size(); ++k) merges.push_back({i, ends[0], ends[k]});
    }
  }
  std::ranges::stable_sort(merges, {},
                           [&](const Merge& merge) { return critical[merge.saddle].pair.distance; });
}

}  // namespace lmdbench
