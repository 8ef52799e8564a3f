// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/lmd/local_tracking.h>
#include <lmdbench/lmd/search_counters.h>
#include <lmdbench/lmd/triangle_pair.h>
#include <lmdbench/methods/improved/improved.h>
#include <lmdbench/methods/improved/visibility.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace lmdbench {

namespace {

Triangle world_triangle(const Surface& surface, const RigidTransform& X_WS, std::int32_t triangle) {
  return X_WS.triangle(surface.mesh.triangle(triangle));
}

Lmd exact_pair(const Surface& moving, const Surface& fixed, std::int32_t fixed_body, std::int32_t t_moving,
               std::int32_t t_fixed, const Triangle& a, const Triangle& b) {
  return lmd_of_triangle_pair(moving, fixed, fixed_body, t_moving, t_fixed, triangle_distance(a, b));
}

bool triangles_less(const Lmd& a, const Lmd& b) {
  return std::tie(a.fixed_body, a.triangle_moving, a.triangle_fixed) <
         std::tie(b.fixed_body, b.triangle_moving, b.triangle_fixed);
}

}  // namespace

Improved::Improved(Scene scene, const ImprovedOptions& options)
    : scene_(std::move(scene)), options_(options), hierarchy_moving_(scene_.moving->prepared<Hierarchy>()) {
  for (const auto& body : scene_.fixed) hierarchies_fixed_.push_back(&body->prepared<Hierarchy>());
}

void Improved::search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  lmds.clear();
  const RigidTransform transform(X_WM);
  for (std::size_t body = 0; body < scene_.fixed.size(); ++body)
    search_body(transform, static_cast<std::int32_t>(body), lmds, counters);
  std::sort(lmds.begin(), lmds.end(), lmd_less);
}

void Improved::search_body(const RigidTransform& X_WM, std::int32_t fixed_body, LmdSet& lmds,
                           WorkCounters& counters) {
  const Surface& moving = scene_.moving->surface();
  const Surface& fixed = scene_.fixed[static_cast<std::size_t>(fixed_body)]->surface();
  const auto visit_leaves = [&](std::int32_t t_moving, std::int32_t t_fixed) {
    const ShadedTriangle a = to_world(shaded_triangle(moving, t_moving), X_WM);
    const ShadedTriangle b = shaded_triangle(fixed, t_fixed);
    if (!see_each_other(a, b, options_.visibility)) {
      ++counters[Counter::REJECTED_VISIBILITY];
      return;
    }
    ++counters[Counter::TRIANGLE_DISTANCES];
    Lmd lmd = exact_pair(moving, fixed, fixed_body, t_moving, t_fixed, a.corners, b.corners);
    if (!(lmd.distance <= scene_.cutoff)) {
      ++counters[Counter::REJECTED_CUTOFF];
      return;
    }
    set_direction(lmd, lmd.direction);
    lmds.push_back(lmd);
  };
  const Hierarchy& hierarchy_fixed = *hierarchies_fixed_[static_cast<std::size_t>(fixed_body)];
  add_traversal<Counter>(
      counters, options_.literal_g3
                    ? traversal_.run<DirectionTest::LITERAL>(hierarchy_moving_, hierarchy_fixed, X_WM,
                                                             scene_.cutoff, visit_leaves)
                    : traversal_.run<DirectionTest::RAY>(hierarchy_moving_, hierarchy_fixed, X_WM,
                                                         scene_.cutoff, visit_leaves));
}

void Improved::track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  const RigidTransform transform(X_WM);
  const Surface& moving = scene_.moving->surface();
  std::sort(lmds.begin(), lmds.end(),
            options_.tracking_order == TrackingOrder::NEAREST_FIRST ? lmd_less : triangles_less);
  cache_.erase();
  kept_.clear();
  std::int32_t number = 0;
  for (const Lmd& lmd : lmds) {
    const Surface& fixed = scene_.fixed[static_cast<std::size_t>(lmd.fixed_body)]->surface();
    const auto evaluate = [&](std::int32_t t_moving, std::int32_t t_fixed) {
      const auto [entry, known] = cache_.find_or_insert(lmd.fixed_body, t_moving, t_fixed);
      if (known) {
        ++counters[Counter::CACHE_HITS];
      } else {
        ++counters[Counter::TRIANGLE_DISTANCES];
        entry->initiator = number;
        entry->lmd = exact_pair(moving, fixed, lmd.fixed_body, t_moving, t_fixed,
                                world_triangle(moving, transform, t_moving), fixed.mesh.triangle(t_fixed));
      }
      return TrackedPair{entry->lmd,
                         options_.reduction == Reduction::PUBLISHED && entry->initiator != number};
    };
    const WalkEnd end = walk_to_minimum(moving, fixed, lmd, evaluate, counters[Counter::TRACKING_STEPS]);
    ++number;
    const bool drop = end.is_duplicate || (options_.reduction == Reduction::LOSS_FREE &&
                                           std::any_of(kept_.begin(), kept_.end(), [&](const Lmd& other) {
                                             return same_feature_pair(other, end.lmd);
                                           }));
    if (drop) {
      ++counters[Counter::DROPPED_DUPLICATES];
    } else {
      kept_.push_back(end.lmd);
    }
  }
  lmds.swap(kept_);
  std::sort(lmds.begin(), lmds.end(), lmd_less);
}

}  // namespace lmdbench
