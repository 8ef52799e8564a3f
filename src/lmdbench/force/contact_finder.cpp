// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/force/contact_finder.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <algorithm>
#include <utility>

namespace lmdbench {

namespace {

double minimum_area_of(const Scene& scene, double share) {
  LMDBENCH_EXPECTS(share >= 0.0, "a share that is negative or not a number");
  if (!scene.moving) return 0.0;
  double diagonal = bounding_box_diagonal(scene.moving->surface().mesh);
  for (const auto& fixed : scene.fixed)
    diagonal = std::min(diagonal, bounding_box_diagonal(fixed->surface().mesh));
  return share * scene.cutoff * diagonal;
}

}  // namespace

ContactFinder::ContactFinder(const Aggregation& aggregation, Scene scene, const LayeredChoice& layered)
    : aggregation_(aggregation),
      minimum_area_(aggregation.needs == AggregationNeeds::SURFACE
                        ? minimum_area_of(scene, layered.minimum_area_share)
                        : 0.0),
      merge_finder_(scene),
      sampler_(std::move(scene), layered.patch_cutoff) {}

void ContactFinder::search(Method& method, const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  if (aggregation_.needs == AggregationNeeds::MINIMA) return method.search(X_WM, lmds, counters);
  method.find_critical(X_WM, critical_, counters);
  LMDBENCH_ENSURES(std::ranges::is_sorted(critical_, lmd_less, &CriticalPair::pair),
                   "a method that gives critical pairs in its own order");
  lmds = minima_of(critical_);
  if (aggregation_.needs == AggregationNeeds::CRITICAL_PAIRS) return;
  merge_finder_.find(X_WM, critical_, merges_);
  if (aggregation_.needs == AggregationNeeds::SURFACE)
    sampler_.find(X_WM, critical_, merges_, merge_finder_, samples_);
}

Wrench ContactFinder::combine(const LmdSet& lmds, const ForceProfile& profile, const Vec3& reference_W) {
  if (aggregation_.name == sum_law().name) return sum_forces(lmds, profile, reference_W);
  if (aggregation_.needs == AggregationNeeds::MINIMA) {
    critical_.clear();
    for (const Lmd& lmd : lmds) critical_.push_back({lmd, 1, true, true, true});
  }
  auto lmd = lmds.begin();
  for (CriticalPair& critical : critical_)
    if (critical.is_minimum && lmd != lmds.end()) critical.pair = *lmd++;
  return aggregation_.combine({critical_, merges_, samples_, minimum_area_}, profile, reference_W);
}

Wrench ContactFinder::wrench_at(Method& method, const Pose& X_WM, const ForceProfile& profile,
                                const Vec3& reference_W) {
  LmdSet lmds;
  WorkCounters ignored;
  search(method, X_WM, lmds, ignored);
  std::ranges::sort(lmds, lmd_less);
  return combine(lmds, profile, reference_W);
}

std::int64_t ContactFinder::without_index(double cutoff) const {
  return std::ranges::count_if(critical_, [&](const CriticalPair& critical) {
    return !critical.has_index && critical.pair.distance < cutoff;
  });
}

}  // namespace lmdbench
