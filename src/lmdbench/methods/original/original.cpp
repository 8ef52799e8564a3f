// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/lmd/local_tracking.h>
#include <lmdbench/lmd/search_counters.h>
#include <lmdbench/lmd/well_formed.h>
#include <lmdbench/methods/original/original.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace lmdbench {

DirectionVerification::DirectionVerification(const Surface& surface, double tolerance_rad)
    : surface_(surface),
      tolerance_cosine_(std::cos(tolerance_rad)),
      tolerance_sine_(std::sin(tolerance_rad)),
      accepts_all_(tolerance_rad >= std::numbers::pi) {
  vertex_cosines_.reserve(surface.mesh.vertices.size());
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v) {
    double half_angle = 0.0;
    for (const std::int32_t t : surface.adjacency.vertex_triangles[static_cast<std::int32_t>(v)]) {
      const double cosine = surface.vertex_normal(static_cast<std::int32_t>(v))
                                .dot(surface.face_normals[static_cast<std::size_t>(t)]);
      half_angle = std::max(half_angle, std::acos(std::clamp(cosine, -1.0, 1.0)));
    }
    vertex_cosines_.push_back(std::cos(std::min(half_angle + tolerance_rad, std::numbers::pi)));
  }
}

bool DirectionVerification::accepts(const FeatureId& feature, const Vec3& direction) const {
  if (accepts_all_ || surface_.is_boundary(feature)) return true;
  const auto i = static_cast<std::size_t>(feature.index);
  switch (feature.kind) {
    case FeatureKind::VERTEX:
      return direction.dot(surface_.vertex_normal(feature.index)) >= vertex_cosines_[i];
    case FeatureKind::EDGE:
      return edge_accepts(feature.index, direction);
    case FeatureKind::FACE:
      break;
  }
  return direction.dot(surface_.face_normals[i]) >= tolerance_cosine_;
}

bool DirectionVerification::edge_accepts(std::int32_t edge, const Vec3& direction) const {
  const auto triangles = surface_.adjacency.edge_triangles[edge];
  for (const std::int32_t t : triangles)
    if (direction.dot(surface_.face_normals[static_cast<std::size_t>(t)]) >= tolerance_cosine_) return true;
  if (triangles.size() != 2) return false;
  // Between the ends of the arc the angle to it is the one to the plane across the edge.
  const Vec3& first = surface_.face_normals[static_cast<std::size_t>(triangles[0])];
  const Vec3& second = surface_.face_normals[static_cast<std::size_t>(triangles[1])];
  const Vec3 across = first.cross(second);
  const double length = across.norm();
  if (length == 0.0) return false;
  const double out_of_plane = direction.dot(across) / length;
  const Vec3 in_plane = direction - (out_of_plane / length) * across;
  const bool within_arc =
      first.cross(in_plane).dot(across) >= 0.0 && in_plane.cross(second).dot(across) >= 0.0;
  return within_arc && (tolerance_cosine_ <= 0.0 || std::abs(out_of_plane) <= tolerance_sine_);
}

namespace {

/// Decision E13: one LMD a pair of features. Leaves the set sorted by `lmd_less`.
void drop_duplicates(LmdSet& lmds, bool merge, WorkCounters& counters) {
  std::sort(lmds.begin(), lmds.end(), lmd_less);
  if (!merge) return;
  const auto end = std::unique(lmds.begin(), lmds.end(), same_feature_pair);
  counters[Original::Counter::DROPPED_DUPLICATES] += static_cast<std::uint64_t>(lmds.end() - end);
  lmds.erase(end, lmds.end());
}

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

}  // namespace

Original::Original(Scene of_pair, const OriginalOptions& options)
    : scene_(std::move(of_pair)),
      options_(options),
      moving_(scene_.moving->surface()),
      fixed_(scene_.fixed_body().surface()),
      hierarchy_moving_(prepared_hierarchy(*scene_.moving, options.leaf_cones)),
      hierarchy_fixed_(prepared_hierarchy(scene_.fixed_body(), options.leaf_cones)),
      verify_moving_(moving_, radians(options.g5_tolerance_deg)),
      verify_fixed_(fixed_, radians(options.g5_tolerance_deg)) {
  if (options.face_neighbourhood == FaceNeighbourhood::OWN) return;
  faces_moving_.emplace(moving_);
  faces_fixed_.emplace(fixed_);
}

template <class Of>
Lmd Original::by_feature_points(Of&& of) const {
  switch (options_.feature_points) {
    case 3:
      return of.template operator()<3>();
    case 13:
      return of.template operator()<13>();
    case 25:
      return of.template operator()<25>();
    default:
      return of.template operator()<7>();
  }
}

template <std::size_t N>
Lmd Original::lmd_of(const FeaturePoints<N>& a, const FeaturePoints<N>& b, const FeaturePointPair& nearest,
                     std::int32_t t_moving, std::int32_t t_fixed) const {
  Lmd lmd;
  lmd.distance = std::sqrt(nearest.squared_distance);
  lmd.point_moving = a[nearest.index_a];
  lmd.point_fixed = b[nearest.index_b];
  lmd.feature_moving = moving_.feature_of(t_moving, part_of_feature_point<N>(nearest.index_a));
  lmd.feature_fixed = fixed_.feature_of(t_fixed, part_of_feature_point<N>(nearest.index_b));
  lmd.triangle_moving = t_moving;
  lmd.triangle_fixed = t_fixed;
  lmd.intersecting = lmd.distance == 0.0;
  return lmd;
}

Lmd Original::feature_point_pair(const RigidTransform& X_WM, std::int32_t t_moving, std::int32_t t_fixed,
                                 WorkCounters& counters) const {
  return by_feature_points([&]<std::size_t N>() {
    const FeaturePoints<N> a = feature_points<N>(X_WM.triangle(moving_.mesh.triangle(t_moving)));
    const FeaturePoints<N> b = feature_points<N>(fixed_.mesh.triangle(t_fixed));
    counters[Counter::FEATURE_POINT_DISTANCES] += N * N;
    return lmd_of<N>(a, b, nearest_feature_points<N>(a, b), t_moving, t_fixed);
  });
}

Lmd Original::moved_point_pair(const RigidTransform& X_WM, const Lmd& lmd, WorkCounters& counters) const {
  return by_feature_points([&]<std::size_t N>() {
    const FeaturePoints<N> a = feature_points<N>(X_WM.triangle(moving_.mesh.triangle(lmd.triangle_moving)));
    const FeaturePoints<N> b = feature_points<N>(fixed_.mesh.triangle(lmd.triangle_fixed));
    FeaturePointPair nearest{std::numeric_limits<double>::infinity(), 0, 0};
    for (std::size_t i = 0; i < N; ++i) {
      if (moving_.feature_of(lmd.triangle_moving, part_of_feature_point<N>(i)) != lmd.feature_moving)
        continue;
      for (std::size_t j = 0; j < N; ++j) {
        if (fixed_.feature_of(lmd.triangle_fixed, part_of_feature_point<N>(j)) != lmd.feature_fixed) continue;
        const double squared_distance = (a[i] - b[j]).squaredNorm();
        ++counters[Counter::FEATURE_POINT_DISTANCES];
        if (squared_distance < nearest.squared_distance) nearest = {squared_distance, i, j};
      }
    }
    return lmd_of<N>(a, b, nearest, lmd.triangle_moving, lmd.triangle_fixed);
  });
}

void Original::search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  lmds.clear();
  const RigidTransform transform(X_WM);
  const auto visit_leaves = [&](std::int32_t t_moving, std::int32_t t_fixed) {
    Lmd lmd = feature_point_pair(transform, t_moving, t_fixed, counters);
    if (!(lmd.distance <= scene_.cutoff)) {
      ++counters[Counter::REJECTED_CUTOFF];
      return;
    }
    set_direction(lmd, lmd.direction);
    if (lmd.distance > 0.0 &&
        !(verify_moving_.accepts(lmd.feature_moving, transform.rotation.transpose() * lmd.direction) &&
          verify_fixed_.accepts(lmd.feature_fixed, -lmd.direction))) {
      ++counters[Counter::REJECTED_G5];
      return;
    }
    lmds.push_back(lmd);
  };
  const auto run = [&]<DirectionTest TEST>() {
    return traversal_.run<TEST>(hierarchy_moving_, hierarchy_fixed_, transform, scene_.cutoff, visit_leaves);
  };
  if (options_.literal_g3) {
    add_traversal<Counter>(counters, run.operator()<DirectionTest::LITERAL>());
  } else if (options_.line_cone == LineCone::TWO_SIDED) {
    add_traversal<Counter>(counters, run.operator()<DirectionTest::LINE>());
  } else {
    add_traversal<Counter>(counters, run.operator()<DirectionTest::RAY>());
  }
  drop_duplicates(lmds, options_.merge_duplicates, counters);
  LMDBENCH_ENSURES(is_well_formed(lmds, scene_), "a pair of triangles named after features of others");
}

void Original::track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  const RigidTransform transform(X_WM);
  const auto evaluate = [&](std::int32_t t_moving, std::int32_t t_fixed) {
    return TrackedPair{feature_point_pair(transform, t_moving, t_fixed, counters)};
  };
  const auto neighbours = [&](const Surface& surface, const FeatureId& feature) {
    if (!faces_moving_ || feature.kind != FeatureKind::FACE) return surface.incident_triangles(feature);
    return (&surface == &moving_ ? *faces_moving_ : *faces_fixed_).of(feature.index);
  };
  for (Lmd& lmd : lmds)
    lmd = walk_to_minimum(moving_, fixed_, lmd, moved_point_pair(transform, lmd, counters), evaluate,
                          counters[Counter::TRACKING_STEPS], neighbours)
              .lmd;
  drop_duplicates(lmds, options_.merge_duplicates, counters);
}

}  // namespace lmdbench
