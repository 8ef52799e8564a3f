// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/lmd/local_tracking.h>
#include <lmdbench/lmd/search_counters.h>
#include <lmdbench/lmd/triangle_pair.h>
#include <lmdbench/lmd/well_formed.h>
#include <lmdbench/methods/improved/improved.h>
#include <lmdbench/methods/improved/visibility.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <tuple>
#include <utility>

namespace lmdbench {

namespace {

/// `shortest_pair`, with whom it was first calculated for.
template <class Cached>
CrowdMemo::Entry look_at_crowd(const TriangleList& moving, const TriangleList& fixed, Cached&& cached) {
  CrowdMemo::Entry crowd;
  bool any = false;
  for (const std::int32_t t_moving : moving) {
    for (const std::int32_t t_fixed : fixed) {
      const ResultCache::Entry& pair = cached(t_moving, t_fixed);
      if (!any || is_shorter(pair.lmd.distance, crowd.lmd.distance)) {
        crowd = {pair.lmd, pair.initiator, false};
        any = true;
      } else if (!is_shorter(crowd.lmd.distance, pair.lmd.distance)) {
        crowd.several |= pair.initiator != crowd.initiator;
      }
    }
  }
  return crowd;
}

bool triangles_less(const Lmd& a, const Lmd& b) {
  return std::tie(a.triangle_moving, a.triangle_fixed) < std::tie(b.triangle_moving, b.triangle_fixed);
}

}  // namespace

Improved::Improved(Scene of_pair, const ImprovedOptions& options)
    : scene_(std::move(of_pair)),
      options_(options),
      moving_(scene_.moving->surface()),
      fixed_(scene_.fixed_body().surface()),
      hierarchy_moving_(prepared_hierarchy(*scene_.moving, options.leaf_cones)),
      hierarchy_fixed_(prepared_hierarchy(scene_.fixed_body(), options.leaf_cones)) {
  if (options.search_threads > 1) {
    team_ = std::make_unique<WorkerTeam>(static_cast<std::size_t>(options.search_threads));
    traversals_.resize(team_->size());
  }
}

void Improved::search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  lmds.clear();
  const RigidTransform transform(X_WM);
  const auto run = [&]<DirectionTest TEST>() {
    if (team_)
      search_in_team<TEST>(transform, lmds, counters);
    else
      search_alone<TEST>(transform, lmds, counters);
  };
  if (options_.literal_g3)
    run.operator()<DirectionTest::LITERAL>();
  else if (options_.clamped_sigma)
    run.operator()<DirectionTest::CLAMPED>();
  else
    run.operator()<DirectionTest::RAY>();
  std::sort(lmds.begin(), lmds.end(), lmd_less);
  LMDBENCH_ENSURES(is_well_formed(lmds, scene_), "a pair of triangles named after features of others");
}

void Improved::visit_leaves(const RigidTransform& X_WM, std::int32_t t_moving, std::int32_t t_fixed,
                            LmdSet& lmds, WorkCounters& counters) const {
  const ShadedTriangle a = to_world(shaded_triangle(moving_, t_moving), X_WM);
  const ShadedTriangle b = shaded_triangle(fixed_, t_fixed);
  if (!see_each_other(a, b, options_.visibility)) {
    ++counters[Counter::REJECTED_VISIBILITY];
    return;
  }
  ++counters[Counter::TRIANGLE_DISTANCES];
  Lmd lmd = lmd_of_triangle_pair(moving_, fixed_, t_moving, t_fixed, triangle_distance(a.corners, b.corners));
  if (!(lmd.distance <= scene_.cutoff)) {
    ++counters[Counter::REJECTED_CUTOFF];
    return;
  }
  set_direction(lmd, lmd.direction);
  lmds.push_back(lmd);
}

template <DirectionTest TEST>
void Improved::search_alone(const RigidTransform& X_WM, LmdSet& lmds, WorkCounters& counters) {
  const auto visit = [&](std::int32_t t_moving, std::int32_t t_fixed) {
    visit_leaves(X_WM, t_moving, t_fixed, lmds, counters);
  };
  add_traversal<Counter>(
      counters, traversal_.run<TEST>(hierarchy_moving_, hierarchy_fixed_, X_WM, scene_.cutoff, visit));
}

template <DirectionTest TEST>
void Improved::search_in_team(const RigidTransform& X_WM, LmdSet& lmds, WorkCounters& counters) {
  // So many that threads which find little take more of them.
  constexpr std::size_t PLACES_A_THREAD = 16;
  TraversalCounters work = traversal_.split<TEST>(hierarchy_moving_, hierarchy_fixed_, X_WM, scene_.cutoff,
                                                  PLACES_A_THREAD * team_->size(), places_);
  if (found_.size() < places_.size()) found_.resize(places_.size());
  std::vector<TraversalCounters> works(team_->size());
  std::vector<WorkCounters> counted(team_->size());
  std::atomic<std::size_t> next{0};
  team_->run([&](std::size_t member) {
    for (std::size_t i = next++; i < places_.size(); i = next++) {
      found_[i].clear();
      const auto visit = [&](std::int32_t t_moving, std::int32_t t_fixed) {
        visit_leaves(X_WM, t_moving, t_fixed, found_[i], counted[member]);
      };
      works[member] += traversals_[member].run_below<TEST>(places_[i], hierarchy_moving_, hierarchy_fixed_,
                                                           X_WM, scene_.cutoff, visit);
    }
  });
  // In the order in which one thread would have found them, so that ties are sorted alike.
  for (std::size_t i = 0; i < places_.size(); ++i)
    lmds.insert(lmds.end(), found_[i].begin(), found_[i].end());
  for (std::size_t member = 0; member < team_->size(); ++member) {
    work += works[member];
    counters += counted[member];
  }
  add_traversal<Counter>(counters, work);
}

void Improved::track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  if (options_.plain_cache)
    track_with(plain_cache_, X_WM, lmds, counters);
  else
    track_with(cache_, X_WM, lmds, counters);
}

template <class Cache>
void Improved::track_with(Cache& cache, const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  const RigidTransform transform(X_WM);
  std::sort(lmds.begin(), lmds.end(),
            options_.tracking_order == TrackingOrder::NEAREST_FIRST ? lmd_less : triangles_less);
  cache.erase();
  crowds_.erase();
  kept_.clear();
  std::int32_t number = 0;
  for (const Lmd& lmd : lmds) {
    const auto cached = [&](std::int32_t t_moving, std::int32_t t_fixed) -> const ResultCache::Entry& {
      const auto [entry, known] = cache.find_or_insert(t_moving, t_fixed);
      if (known) {
        ++counters[Counter::CACHE_HITS];
      } else {
        ++counters[Counter::TRIANGLE_DISTANCES];
        entry->initiator = number;
        entry->lmd =
            lmd_of_triangle_pair(moving_, fixed_, t_moving, t_fixed,
                                 triangle_distance(transform.triangle(moving_.mesh.triangle(t_moving)),
                                                   fixed_.mesh.triangle(t_fixed)));
      }
      return *entry;
    };
    const auto evaluate = [&](std::int32_t t_moving, std::int32_t t_fixed) {
      const ResultCache::Entry& entry = cached(t_moving, t_fixed);
      return TrackedPair{entry.lmd, options_.reduction == Reduction::PUBLISHED && entry.initiator != number};
    };
    const auto look = [&](const FeatureId& feature_moving, const FeatureId& feature_fixed) {
      const TriangleList around_moving = moving_.incident_triangles(feature_moving);
      const TriangleList around_fixed = fixed_.incident_triangles(feature_fixed);
      const std::size_t pairs = around_moving.size() * around_fixed.size();
      if (pairs < CROWD_PAIRS) return shortest_pair(around_moving, around_fixed, evaluate);
      const auto [entry, known] = crowds_.find_or_look(
          feature_moving, feature_fixed, [&] { return look_at_crowd(around_moving, around_fixed, cached); });
      if (known) counters[Counter::CACHE_HITS] += pairs;
      return TrackedPair{entry.lmd,
                         options_.reduction == Reduction::PUBLISHED && entry.seen_by_other(number)};
    };
    const Lmd there = cached(lmd.triangle_moving, lmd.triangle_fixed).lmd;
    const WalkEnd end = walk_by(lmd, there, look, counters[Counter::TRACKING_STEPS]);
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
