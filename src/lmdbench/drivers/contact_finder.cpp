// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/drivers/contact_finder.h>
#include <lmdbench/lmd/own_wrench.h>
#include <lmdbench/scene/mesh_bounds.h>
#include <lmdbench/scene/mesh_pair.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace lmdbench {

namespace {

/// A patch of the first mesh of a pair as the second one feels it, at the distance's other end.
SurfaceSample turned_round(const SurfaceSample& sample) {
  SurfaceSample turned = sample;
  turned.point_moving += sample.distance * sample.direction;
  turned.direction = -sample.direction;
  return turned;
}

/// Unset where the method has none.
std::optional<Wrench> own_force_of(const Method* method, std::size_t mover, const ForceProfile& profile,
                                   const Vec3& reference_W) {
  const auto own = method != nullptr ? own_wrench_of(*method, mover) : std::nullopt;
  if (!own) return std::nullopt;
  return Wrench{profile.own_scale * own->force, profile.own_scale * own->torque_about(reference_W),
                std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace

ContactFinder::ContactFinder(const Aggregation& aggregation, Scene scene, const LayeredChoice& layered)
    : aggregation_(aggregation), scene_(std::move(scene)), layered_(layered) {
  LMDBENCH_EXPECTS(layered.minimum_area_share >= 0.0, "a share that is negative or not a number");
}

void ContactFinder::search(Method& method, const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  if (aggregation_.needs == AggregationNeeds::MINIMA) return method.search(X_WM, lmds, counters);
  method.find_critical(X_WM, critical_, counters);
  LMDBENCH_ENSURES(std::ranges::is_sorted(critical_, lmd_less, &CriticalPair::pair),
                   "a method that gives critical pairs in its own order");
  lmds = minima_of(critical_);
  if (aggregation_.needs != AggregationNeeds::CRITICAL_PAIRS) find_merges(X_WM);
}

const NearFrame& ContactFinder::near_frame_of(const ObjectPair& pair) {
  const Body &moving = *scene_.body(pair.mover), &fixed = *scene_.body(pair.other);
  const std::uint64_t deformations = std::uint64_t{moving.deformations()} + fixed.deformations();
  const auto found = near_.find({&moving, &fixed});
  // One that does not differ has the bodies themselves.
  if (found != near_.end() && (!found->second.frame.differs() || found->second.deformations == deformations))
    return found->second.frame;
  return near_.insert_or_assign({&moving, &fixed}, Near{NearFrame(pair.scene_of(scene_)), deformations})
      .first->second.frame;
}

void ContactFinder::find_merges(const Pose& X_WM) {
  merges_.clear();
  samples_.clear();
  minimum_areas_.assign(aggregation_.needs == AggregationNeeds::SURFACE ? critical_.size() : 0, 0.0);
  std::map<std::int32_t, std::vector<std::size_t>> by_pair;
  for (std::size_t i = 0; i < critical_.size(); ++i) by_pair[critical_[i].pair.fixed_body].push_back(i);
  CriticalSet own;
  std::vector<Merge> merges;
  std::vector<SurfaceSample> samples;
  for (const auto& [number, places] : by_pair) {
    const ObjectPair pair = ObjectPair::of(number, scene_);
    const NearFrame& near = near_frame_of(pair);
    PlacedPair place = PlacedPair::of(scene_, pair, X_WM);
    place.X_FM = near.to_near(place.X_FM);
    place.origin_F = near.origin_W();
    own.clear();
    for (const std::size_t i : places) place.to_mesh(own.emplace_back(critical_[i]).pair);
    MergeFinder finder(near.scene());
    finder.find(place.X_FM, own, merges);
    for (const Merge& merge : merges)
      merges_.push_back({places[merge.saddle], places[merge.first], places[merge.second]});
    if (aggregation_.needs != AggregationNeeds::SURFACE) continue;
    const double smaller = std::min(scene_.body(pair.mover)->diagonal(), scene_.body(pair.other)->diagonal());
    for (const std::size_t i : places)
      minimum_areas_[i] = layered_.minimum_area_share * scene_.cutoff * smaller;
    SurfaceSampler(near.scene(), layered_.patch_cutoff).find(place.X_FM, own, merges, finder, samples);
    for (SurfaceSample& sample : samples) {
      sample.point_moving += place.origin_F;
      if (!place.is_world) {
        sample.direction = place.X_WF.direction(sample.direction);
        sample.point_moving = place.X_WF.point(sample.point_moving);
      }
      sample.minimum = places[sample.minimum];
      samples_.push_back(sample);
    }
  }
  std::ranges::stable_sort(merges_, {}, [&](const Merge& m) { return critical_[m.saddle].pair.distance; });
}

void ContactFinder::take(const LmdSet& lmds) {
  if (aggregation_.needs == AggregationNeeds::MINIMA) {
    critical_.clear();
    for (const Lmd& lmd : lmds) critical_.push_back({lmd, 1, true, true, true});
  }
  auto lmd = lmds.begin();
  for (CriticalPair& critical : critical_)
    if (critical.is_minimum && lmd != lmds.end()) critical.pair = *lmd++;
}

void ContactFinder::split(const LmdSet& lmds) {
  parts_.resize(scene_.mover_count());
  for (Part& part : parts_) part = {};
  for (const Lmd& lmd : lmds) {
    const ObjectPair pair = ObjectPair::of(lmd.fixed_body, scene_);
    LMDBENCH_EXPECTS(pair.mover < parts_.size() && pair.other < scene_.object_count(),
                     "an LMD of another scene");
    parts_[pair.mover].lmds.push_back(lmd);
    if (scene_.is_mover(pair.other)) parts_[pair.other].lmds.push_back(lmdbench::turned_round(lmd));
  }
  if (is_sum()) return;
  take(lmds);
  // Each of a mover's pairs as the mover sees it; the others name pairs by their place in its set.
  std::vector<std::size_t> place(critical_.size());
  for (std::size_t mover = 0; mover < parts_.size(); ++mover) {
    Part& part = parts_[mover];
    std::vector<bool> is_own(critical_.size(), false), is_turned(critical_.size(), false);
    for (std::size_t i = 0; i < critical_.size(); ++i) {
      const ObjectPair pair = ObjectPair::of(critical_[i].pair.fixed_body, scene_);
      is_turned[i] = pair.other == mover;
      is_own[i] = is_turned[i] || pair.mover == mover;
      if (!is_own[i]) continue;
      place[i] = part.critical.size();
      part.critical.push_back(critical_[i]);
      if (!minimum_areas_.empty()) part.minimum_areas.push_back(minimum_areas_[i]);
      if (is_turned[i]) part.critical.back().pair = lmdbench::turned_round(critical_[i].pair);
    }
    for (const Merge& merge : merges_)
      if (is_own[merge.saddle])
        part.merges.push_back({place[merge.saddle], place[merge.first], place[merge.second]});
    for (const SurfaceSample& sample : samples_) {
      if (!is_own[sample.minimum]) continue;
      part.samples.push_back(is_turned[sample.minimum] ? turned_round(sample) : sample);
      part.samples.back().minimum = place[sample.minimum];
    }
  }
}

Wrench ContactFinder::wrench_on(std::size_t mover, const ForceProfile& profile, const Vec3& reference_W,
                                const Method* method) const {
  if (const auto own = own_force_of(method, mover, profile, reference_W)) return *own;
  const Part& part = parts_[mover];
  if (is_sum()) return sum_forces(part.lmds, profile, reference_W);
  return aggregation_.combine({part.critical, part.merges, part.samples, part.minimum_areas}, profile,
                              reference_W);
}

Wrench ContactFinder::combine(const LmdSet& lmds, const ForceProfile& profile, const Vec3& reference_W,
                              const Method* method) {
  if (scene_.several_move()) {
    split(lmds);
    return wrench_on(scene_.held, profile, reference_W, method);
  }
  if (const auto own = own_force_of(method, 0, profile, reference_W)) return *own;
  if (is_sum()) return sum_forces(lmds, profile, reference_W);
  take(lmds);
  return aggregation_.combine({critical_, merges_, samples_, minimum_areas_}, profile, reference_W);
}

Wrench ContactFinder::wrench_at(Method& method, const Pose& X_WM, const ForceProfile& profile,
                                const Vec3& reference_W) {
  LmdSet lmds;
  WorkCounters ignored;
  search(method, X_WM, lmds, ignored);
  std::ranges::sort(lmds, lmd_less);
  return combine(lmds, profile, reference_W, &method);
}

std::int64_t ContactFinder::without_index(double cutoff) const {
  return std::ranges::count_if(critical_, [&](const CriticalPair& critical) {
    return !critical.has_index && critical.pair.distance < cutoff;
  });
}

}  // namespace lmdbench
