// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/scene/scene_search.h>

#include <algorithm>
#include <utility>

namespace lmdbench {
namespace {

/// Its values are the last of WorkCounters, behind those of any method.
enum class SceneCounter : std::uint8_t {
  BROAD_PHASE_QUERIES = WorkCounters::CAPACITY - 3,
  PAIRS_TOUCHED,
  PAIRS_SEARCHED
};

Lmd& lmd_of(Lmd& lmd) {
  return lmd;
}
Lmd& lmd_of(CriticalPair& critical) {
  return critical.pair;
}

}  // namespace

SceneSearch::SceneSearch(const Scene& scene, const MethodDescription& description, MeshPair::Make make,
                         const BroadPhase::Tuning& tuning)
    : scene_(std::make_shared<const Scene>(scene)),
      description_(description),
      make_(std::move(make)),
      has_own_force_(description.has_own_force()),
      own_(scene.mover_count()) {
  LMDBENCH_EXPECTS(ObjectPair::have_numbers(scene), "more pairs than `Lmd::fixed_body` has numbers");
  LMDBENCH_EXPECTS(!scene.several_move() ||
                       (scene.mover_poses != nullptr && scene.mover_poses->size() == scene.movers.size()),
                   "movers of which nobody says where they are");
  // Bodies are prepared now, not when they first come near; pairs of several movers beyond the
  // first one's are made when they meet.
  for (std::uint32_t other = 1; other < scene.object_count(); ++other) methods_of({0, other});
  // An instance of the method knows better what its options make of it.
  if (scene.object_count() > 1) description_ = methods_of({0, 1}).shared().description();
  if (scene.is_pair()) {
    pair_ = &methods_of({0, 1});
    return;
  }
  description_ = over_scene(description_);
  if (description_.brute_force)
    all_.emplace(*scene_);
  else
    phase_.emplace(scene_, tuning);
}

SceneSearch::Meshes SceneSearch::meshes_of(const ObjectPair& pair) const {
  return {scene_->body(pair.mover).get(), scene_->body(pair.other).get()};
}

MeshPair& SceneSearch::methods_of(const ObjectPair& pair) {
  const Meshes meshes = meshes_of(pair);
  const auto found = methods_.find(meshes);
  if (found == methods_.end())
    return methods_.try_emplace(meshes, pair.scene_of(*scene_), make_).first->second;
  if (found->second.follow_deformation() && phase_)
    for (std::vector<BroadPhase::Candidate>* all : {&phase_->candidates(), &phase_->dropped()})
      for (BroadPhase::Candidate& candidate : *all)
        if (meshes_of(candidate) == meshes) candidate.method.reset();
  return found->second;
}

std::size_t SceneSearch::method_count() const {
  std::size_t count = 0;
  for (const auto& [meshes, methods] : methods_) count += methods.made();
  return count;
}

template <class Ask>
void SceneSearch::for_each_near(const Pose& X_WM, WorkCounters& counters, const Ask& ask) {
  const auto placed = [&](const MeshPair& methods, const ObjectPair& pair) {
    ++counters[SceneCounter::PAIRS_SEARCHED];
    return methods.in_near_frame(PlacedPair::of(*scene_, pair, X_WM));
  };
  if (all_) {
    for (const auto& [bound, pair] : all_->within(contact_reach(*scene_), X_WM)) {
      MeshPair& methods = methods_of(pair);
      ask(pair, methods.shared(), placed(methods, pair));
    }
    counters[SceneCounter::PAIRS_TOUCHED] += scene_->mover_count() * (scene_->object_count() - 1);
    return;
  }
  BroadPhase::Work work;
  phase_->advance(X_WM, work);
  for (BroadPhase::Candidate& gone : phase_->dropped())
    if (MeshPair& methods = methods_of(gone); gone.method) methods.give_back(std::move(gone.method));
  phase_->dropped().clear();
  phase_->for_each_near(work, [&](BroadPhase::Candidate& near) {
    MeshPair& methods = methods_of(near);
    if (methods.keeps_frames() && !near.method) near.method = methods.take();
    ask(near, methods.keeps_frames() ? *near.method : methods.shared(), placed(methods, near));
  });
  counters[SceneCounter::BROAD_PHASE_QUERIES] += work.queries;
  counters[SceneCounter::PAIRS_TOUCHED] += work.touched;
}

template <class Set, class Find>
void SceneSearch::gather(const Pose& X_WM, Set& of_pair, Set& set, WorkCounters& counters, const Find& find) {
  if (has_own_force_) own_.assign(own_.size(), std::nullopt);
  if (pair_ != nullptr) {
    pair_->follow_deformation();
    if (!pair_->frame().differs()) {
      find(pair_->shared(), X_WM, set);
      return add_own_wrench(pair_->shared(), {0, 1}, {});
    }
    const PlacedPair place = pair_->in_near_frame(PlacedPair::of(*scene_, {0, 1}, X_WM));
    find(pair_->shared(), place.X_FM, set);
    add_own_wrench(pair_->shared(), {0, 1}, place);
    for (auto& one : set) place.to_world(lmd_of(one), 0);
    return;
  }
  set.clear();
  for_each_near(X_WM, counters, [&](const ObjectPair& pair, Method& method, const PlacedPair& place) {
    find(method, place.X_FM, of_pair);
    add_own_wrench(method, pair, place);
    for (auto& one : of_pair) place.to_world(lmd_of(one), pair.number(*scene_));
    set.insert(set.end(), of_pair.begin(), of_pair.end());
  });
}

/// The second mesh of a pair feels the opposite of what the first one feels.
void SceneSearch::add_own_wrench(const Method& method, const ObjectPair& pair, const PlacedPair& place) {
  if (!has_own_force_) return;
  const std::optional<OwnWrench> of_pair = own_wrench_of(method);
  if (!of_pair) return;
  const OwnWrench own{place.X_WF.direction(of_pair->force), place.X_WF.direction(of_pair->torque),
                      place.X_WF.point(of_pair->about + place.origin_F)};
  const auto add = [&](std::size_t mover, double sign) {
    std::optional<OwnWrench>& sum = own_[mover];
    if (!sum) sum = OwnWrench{.about = own.about};
    sum->torque += sign * own.torque_about(sum->about);
    sum->force += sign * own.force;
  };
  add(pair.mover, 1.0);
  if (scene_->is_mover(pair.other)) add(pair.other, -1.0);
}

void SceneSearch::search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  gather(X_WM, of_pair_, lmds, counters,
         [&](Method& method, const Pose& X_FM, LmdSet& found) { method.search(X_FM, found, counters); });
  if (pair_ != nullptr) return;
  std::sort(lmds.begin(), lmds.end(), lmd_less);
  if (description_.promise == Promise::NEAREST_PAIR) keep_nearest_of_each_mover(lmds);
}

void SceneSearch::find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) {
  gather(X_WM, critical_of_pair_, critical, counters,
         [&](Method& method, const Pose& X_FM, CriticalSet& found) {
           method.find_critical(X_FM, found, counters);
         });
  if (pair_ == nullptr) sort_critical(critical);
}

/// @param lmds in the order of distances
void SceneSearch::keep_nearest_of_each_mover(LmdSet& lmds) {
  has_nearest_.assign(scene_->mover_count(), false);
  std::erase_if(lmds, [&](const Lmd& lmd) {
    const ObjectPair pair = ObjectPair::of(lmd.fixed_body, *scene_);
    bool nearest = !has_nearest_[pair.mover];
    has_nearest_[pair.mover] = true;
    if (scene_->is_mover(pair.other)) {
      nearest = nearest || !has_nearest_[pair.other];
      has_nearest_[pair.other] = true;
    }
    return !nearest;
  });
}

void SceneSearch::track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  if (!description_.tracks_locally) return search(X_WM, lmds, counters);
  const auto track_pair = [&](std::int32_t number, LmdSet& set) {
    const ObjectPair pair = ObjectPair::of(number, *scene_);
    MeshPair& methods = methods_of(pair);
    const PlacedPair place = methods.in_near_frame(PlacedPair::of(*scene_, pair, X_WM));
    for (Lmd& lmd : set) place.to_mesh(lmd);
    methods.shared().track(place.X_FM, set, counters);
    for (Lmd& lmd : set) place.to_world(lmd, number);
  };
  if (pair_ != nullptr) {
    pair_->follow_deformation();
    return pair_->frame().differs() ? track_pair(0, lmds) : pair_->shared().track(X_WM, lmds, counters);
  }
  std::stable_sort(lmds.begin(), lmds.end(),
                   [](const Lmd& a, const Lmd& b) { return a.fixed_body < b.fixed_body; });
  tracked_.clear();
  for (auto begin = lmds.begin(), end = begin; begin != lmds.end(); begin = end) {
    const std::int32_t number = begin->fixed_body;
    end = std::find_if(begin, lmds.end(), [&](const Lmd& lmd) { return lmd.fixed_body != number; });
    of_pair_.assign(begin, end);
    track_pair(number, of_pair_);
    tracked_.insert(tracked_.end(), of_pair_.begin(), of_pair_.end());
  }
  lmds = tracked_;
  std::sort(lmds.begin(), lmds.end(), lmd_less);
}

MethodDescription over_scene(MethodDescription description) {
  description.counters.insert(
      description.counters.end(),
      {{SceneCounter::BROAD_PHASE_QUERIES, "broad_phase_queries",
        "queries of the broad phase, one a mover that left the slack about its last place",
        CountedBy::SEARCH},
       {SceneCounter::PAIRS_TOUCHED, "pairs_touched",
        "pairs of objects whose bounds were placed or whose room was used up", CountedBy::SEARCH},
       {SceneCounter::PAIRS_SEARCHED, "pairs_searched", "pairs of objects whose meshes were searched",
        CountedBy::SEARCH}});
  return description;
}

}  // namespace lmdbench
