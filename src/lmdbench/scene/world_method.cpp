// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/lmd/own_wrench.h>
#include <lmdbench/scene/broad_phase.h>
#include <lmdbench/scene/mesh_pair.h>
#include <lmdbench/scene/mover_method.h>
#include <lmdbench/scene/world_method.h>

#include <algorithm>
#include <utility>

namespace lmdbench {

namespace {

/// Its values are the last of WorkCounters, behind those of any method.
enum class WorldCounter : std::uint8_t {
  BROAD_PHASE_QUERIES = WorkCounters::CAPACITY - 3,
  INSTANCES_TOUCHED,
  INSTANCES_SEARCHED
};

class WorldMethod : public Method, public HasOwnWrench {
 public:
  WorldMethod(const Scene& scene, const MethodDescription& description, MeshPair::Make make)
      : broad_phase_(scene), description_(in_world(description)), make_(std::move(make)) {
    for (const auto& mesh : broad_phase_.meshes())
      meshes_.emplace_back(Scene{scene.moving, {mesh}, scene.cutoff}, make_);
  }

  const MethodDescription& description() const override { return description_; }

  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    lmds.clear();
    own_ = {.about = X_WM.translation};
    for_each_near(X_WM, counters, [&](Method& method, std::uint32_t instance, const PlacedPair& place) {
      method.search(place.X_FM, found_, counters);
      if (const std::optional<OwnWrench> own = own_wrench_of(method)) add_own(*own, place);
      for (Lmd& lmd : found_) place.to_world(lmd, instance);
      lmds.insert(lmds.end(), found_.begin(), found_.end());
    });
    std::sort(lmds.begin(), lmds.end(), lmd_less);
    if (description_.promise == Promise::NEAREST_PAIR && lmds.size() > 1) lmds.resize(1);
  }

  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    if (!description_.tracks_locally) return search(X_WM, lmds, counters);
    // A set follows the motion wherever its pairs are: no broad phase.
    std::stable_sort(lmds.begin(), lmds.end(),
                     [](const Lmd& a, const Lmd& b) { return a.fixed_body < b.fixed_body; });
    tracked_.clear();
    for (std::size_t begin = 0, end = 0; begin < lmds.size(); begin = end) {
      const auto instance = static_cast<std::uint32_t>(lmds[begin].fixed_body);
      while (end < lmds.size() && lmds[end].fixed_body == lmds[begin].fixed_body) ++end;
      const PlacedPair place = place_of(instance, X_WM);
      found_.assign(lmds.begin() + static_cast<std::ptrdiff_t>(begin),
                    lmds.begin() + static_cast<std::ptrdiff_t>(end));
      for (Lmd& lmd : found_) place.to_mesh(lmd);
      mesh_of(instance).shared().track(place.X_FM, found_, counters);
      for (Lmd& lmd : found_) place.to_world(lmd, instance);
      tracked_.insert(tracked_.end(), found_.begin(), found_.end());
    }
    lmds = tracked_;
  }

  void find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) override {
    critical.clear();
    CriticalSet found;
    for_each_near(X_WM, counters, [&](Method& method, std::uint32_t instance, const PlacedPair& place) {
      method.find_critical(place.X_FM, found, counters);
      for (CriticalPair& pair : found) place.to_world(pair.pair, instance);
      critical.insert(critical.end(), found.begin(), found.end());
    });
    sort_critical(critical);
  }

  std::optional<OwnWrench> own_wrench() const override {
    return shows_own_force_ ? std::optional(own_) : std::nullopt;
  }

 private:
  void add_own(const OwnWrench& own, const PlacedPair& place) {
    const OwnWrench in_world{place.X_WF.direction(own.force), place.X_WF.direction(own.torque),
                             place.X_WF.point(own.about + place.origin_F)};
    shows_own_force_ = true;
    own_.force += in_world.force;
    own_.torque += in_world.torque_about(own_.about);
  }

  /// An instance that was near, with the method that has been given to it.
  struct Given {
    std::uint32_t instance;
    std::unique_ptr<Method> method;
  };

  MeshPair& mesh_of(std::uint32_t instance) { return meshes_[broad_phase_.mesh_of(instance)]; }

  PlacedPair place_of(std::uint32_t instance, const Pose& X_WM) const {
    return meshes_[broad_phase_.mesh_of(instance)].placed(broad_phase_.pose_of(instance), X_WM);
  }

  /// Calls ask(method, instance, place) for each instance that may be within reach.
  template <class Ask>
  void for_each_near(const Pose& X_WM, WorkCounters& counters, Ask&& ask) {
    near_.clear();
    if (description_.brute_force) {
      broad_phase_.look_at_all(X_WM, near_);
      counters[WorldCounter::INSTANCES_TOUCHED] += broad_phase_.size();
    } else {
      BroadPhase::Work work;
      if (broad_phase_.advance(X_WM, work)) take_back();
      counters[WorldCounter::BROAD_PHASE_QUERIES] += work.queries;
      counters[WorldCounter::INSTANCES_TOUCHED] += work.touched;
      for (std::size_t i = 0; i < broad_phase_.near_count(); ++i)
        near_.push_back(broad_phase_.candidates()[i].instance);
    }
    counters[WorldCounter::INSTANCES_SEARCHED] += near_.size();
    for (const std::uint32_t instance : near_) ask(method_for(instance), instance, place_of(instance, X_WM));
  }

  Method& method_for(std::uint32_t instance) {
    if (!mesh_of(instance).keeps_frames()) return mesh_of(instance).shared();
    const auto has = [&](const Given& given) { return given.instance == instance; };
    const auto found = std::find_if(given_.begin(), given_.end(), has);
    if (found != given_.end()) return *found->method;
    given_.push_back({instance, mesh_of(instance).take(make_)});
    return *given_.back().method;
  }

  /// After a query: instances that are no candidates any more give their methods back.
  void take_back() {
    const auto is_candidate = [&](const Given& given) {
      return std::any_of(broad_phase_.candidates().begin(), broad_phase_.candidates().end(),
                         [&](const BroadPhase::Candidate& c) { return c.instance == given.instance; });
    };
    const auto gone = std::stable_partition(given_.begin(), given_.end(), is_candidate);
    for (auto given = gone; given != given_.end(); ++given)
      mesh_of(given->instance).give_back(std::move(given->method));
    given_.erase(gone, given_.end());
  }

  BroadPhase broad_phase_;
  MethodDescription description_;
  MeshPair::Make make_;
  std::vector<MeshPair> meshes_;
  std::vector<Given> given_;
  std::vector<std::uint32_t> near_;
  LmdSet found_, tracked_;
  bool shows_own_force_ = false;  ///< Once a pair's method has.
  OwnWrench own_;
};

}  // namespace

MethodDescription in_world(MethodDescription description) {
  description.counters.insert(
      description.counters.end(),
      {{WorldCounter::BROAD_PHASE_QUERIES, "broad_phase_queries", "queries of the tree over instances",
        CountedBy::SEARCH},
       {WorldCounter::INSTANCES_TOUCHED, "instances_touched",
        "instances whose bounds were placed or whose room was used up", CountedBy::SEARCH},
       {WorldCounter::INSTANCES_SEARCHED, "instances_searched", "instances whose meshes were searched",
        CountedBy::SEARCH}});
  return description;
}

std::unique_ptr<Method> make_in_world(const Scene& scene, const MethodDescription& description,
                                      const std::function<std::unique_ptr<Method>(const Scene&)>& make) {
  if (scene.several_move()) return make_among_movers(scene, description, make);
  if (!scene.is_world()) return make_in_near_frame(scene, make);
  return std::make_unique<WorldMethod>(scene, description, make);
}

}  // namespace lmdbench
