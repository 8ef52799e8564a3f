// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/scene/mesh_bounds.h>
#include <lmdbench/scene/mover_group.h>
#include <lmdbench/scene/mover_method.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace lmdbench {
namespace {

/// Its values are the last of WorkCounters, behind those of any method.
enum class MoverCounter : std::uint8_t {
  MOVERS_ANCHORED = WorkCounters::CAPACITY - 3,
  PAIRS_TOUCHED,
  PAIRS_SEARCHED
};

/// The nearest LMD of each mover, of a set in the order of distances.
void keep_nearest_of_each(LmdSet& lmds, const Scene& scene) {
  std::vector<bool> has(scene.mover_count(), false);
  std::erase_if(lmds, [&](const Lmd& lmd) {
    const ObjectPair pair = ObjectPair::of(lmd.fixed_body, scene);
    bool nearest = !has[pair.mover];
    has[pair.mover] = true;
    if (scene.is_mover(pair.other)) {
      nearest = nearest || !has[pair.other];
      has[pair.other] = true;
    }
    return !nearest;
  });
}

class MoverMethod : public Method {
 public:
  MoverMethod(const Scene& scene, const MethodDescription& description, MeshPair::Make make)
      : scene_(scene), description_(among_movers(description)), make_(std::move(make)), near_(scene_) {
    if (!description_.brute_force) group_.emplace(scene.movers, scene.fixed, scene.cutoff, make_);
    double known = 0.0;
    for (std::size_t i = 0; i < scene.object_count(); ++i)
      known = std::max(known, scene.body(i)->prepared<MeshBounds>().known);
    reach_ = scene.cutoff + 4.0 * known;
  }

  const MethodDescription& description() const override { return description_; }

  void search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    lmds.clear();
    for_each_near(X_WM, counters, [&](const ObjectPair& pair, Method& method, const PlacedPair& place) {
      method.search(place.X_FM, found_, counters);
      const auto number = static_cast<std::uint32_t>(pair.number(scene_));
      for (Lmd& lmd : found_) place.to_world(lmd, number);
      lmds.insert(lmds.end(), found_.begin(), found_.end());
    });
    std::sort(lmds.begin(), lmds.end(), lmd_less);
    if (description_.promise == Promise::NEAREST_PAIR) keep_nearest_of_each(lmds, scene_);
  }

  void track(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) override {
    if (!description_.tracks_locally) return search(X_WM, lmds, counters);
    std::stable_sort(lmds.begin(), lmds.end(),
                     [](const Lmd& a, const Lmd& b) { return a.fixed_body < b.fixed_body; });
    tracked_.clear();
    for (std::size_t begin = 0, end = 0; begin < lmds.size(); begin = end) {
      const std::int32_t number = lmds[begin].fixed_body;
      while (end < lmds.size() && lmds[end].fixed_body == number) ++end;
      const ObjectPair pair = ObjectPair::of(number, scene_);
      MeshPair& meshes = meshes_of(pair);
      const PlacedPair place = placed(meshes, pair, X_WM);
      found_.assign(lmds.begin() + static_cast<std::ptrdiff_t>(begin),
                    lmds.begin() + static_cast<std::ptrdiff_t>(end));
      for (Lmd& lmd : found_) place.to_mesh(lmd);
      meshes.shared().track(place.X_FM, found_, counters);
      for (Lmd& lmd : found_) place.to_world(lmd, static_cast<std::uint32_t>(number));
      tracked_.insert(tracked_.end(), found_.begin(), found_.end());
    }
    lmds = tracked_;
  }

  void find_critical(const Pose& X_WM, CriticalSet& critical, WorkCounters& counters) override {
    critical.clear();
    CriticalSet found;
    for_each_near(X_WM, counters, [&](const ObjectPair& pair, Method& method, const PlacedPair& place) {
      method.find_critical(place.X_FM, found, counters);
      const auto number = static_cast<std::uint32_t>(pair.number(scene_));
      for (CriticalPair& one : found) place.to_world(one.pair, number);
      critical.insert(critical.end(), found.begin(), found.end());
    });
    sort_critical(critical);
  }

 private:
  /// Calls ask(pair, method, place) for each pair of objects that may be within reach.
  template <class Ask>
  void for_each_near(const Pose& X_WM, WorkCounters& counters, const Ask& ask) {
    if (description_.brute_force) {
      const std::vector<NearPairs::Pair>& near = near_.within(reach_, X_WM);
      for (const auto& [bound, pair] : near) {
        MeshPair& meshes = meshes_of(pair);
        ask(pair, meshes.shared(), placed(meshes, pair, X_WM));
      }
      counters[MoverCounter::PAIRS_TOUCHED] += scene_.mover_count() * (scene_.object_count() - 1);
      counters[MoverCounter::PAIRS_SEARCHED] += near.size();
      return;
    }
    poses_ = *scene_.mover_poses;
    poses_[scene_.held] = X_WM;
    MoverGroup::Work work;
    group_->for_each_near(
        poses_, work, [&](std::uint32_t mover, std::uint32_t other, Method& method, const PlacedPair& place) {
          ask(ObjectPair{mover, other}, method, place);
        });
    counters[MoverCounter::MOVERS_ANCHORED] += work.anchored;
    counters[MoverCounter::PAIRS_TOUCHED] += work.pairs_touched;
    counters[MoverCounter::PAIRS_SEARCHED] += work.pairs_searched;
  }

  PlacedPair placed(const MeshPair& meshes, const ObjectPair& pair, const Pose& X_WM) const {
    return meshes.placed(scene_.pose(pair.other, X_WM), scene_.pose(pair.mover, X_WM));
  }

  MeshPair& meshes_of(const ObjectPair& pair) {
    const std::pair key(scene_.body(pair.mover).get(), scene_.body(pair.other).get());
    const auto found = meshes_.find(key);
    if (found != meshes_.end()) return found->second;
    return meshes_.try_emplace(key, pair.scene_of(scene_), make_).first->second;
  }

  const Scene scene_;
  MethodDescription description_;
  MeshPair::Make make_;
  NearPairs near_;
  std::optional<MoverGroup> group_;  ///< But of truth.
  double reach_ = 0.0;
  std::map<std::pair<const Body*, const Body*>, MeshPair> meshes_;  ///< For tracking, and of truth.
  std::vector<Pose> poses_;
  LmdSet found_, tracked_;
};

}  // namespace

bool pairs_have_numbers(const Scene& scene) {
  return scene.object_count() <=
         static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) / scene.mover_count();
}

const std::vector<NearPairs::Pair>& NearPairs::within(double reach, const Pose& X_WM) {
  pairs_.clear();
  centres_.clear();
  radii_.clear();
  rounding_.clear();
  for (std::size_t i = 0; i < scene_.object_count(); ++i) {
    const MeshBounds& bounds = scene_.body(i)->prepared<MeshBounds>();
    const RigidTransform X_WB(scene_.pose(i, X_WM));
    centres_.push_back(X_WB.point(bounds.centre));
    radii_.push_back(bounds.radius);
    rounding_.push_back(4.0 * PLACING_ROUNDING * bounds.coordinates(X_WB));
  }
  for (std::uint32_t mover = 0; mover < scene_.mover_count(); ++mover)
    for (std::uint32_t other = mover + 1; other < centres_.size(); ++other) {
      const double between = (centres_[mover] - centres_[other]).norm() - radii_[mover] - radii_[other] -
                             rounding_[mover] - rounding_[other];
      if (between <= reach) pairs_.push_back({std::max(between, 0.0), {mover, other}});
    }
  std::ranges::sort(pairs_, [](const Pair& a, const Pair& b) {
    return std::tie(a.at_least, a.objects.mover, a.objects.other) <
           std::tie(b.at_least, b.objects.mover, b.objects.other);
  });
  return pairs_;
}

std::unique_ptr<Method> make_among_movers(const Scene& scene, const MethodDescription& description,
                                          MeshPair::Make make) {
  LMDBENCH_EXPECTS(pairs_have_numbers(scene), "more pairs than `Lmd::fixed_body` has numbers");
  LMDBENCH_EXPECTS(scene.mover_poses != nullptr && scene.mover_poses->size() == scene.movers.size(),
                   "movers of which nobody says where they are");
  return std::make_unique<MoverMethod>(scene, description, std::move(make));
}

MethodDescription among_movers(MethodDescription description) {
  description.counters.insert(
      description.counters.end(),
      {{MoverCounter::MOVERS_ANCHORED, "movers_anchored", "movers that left the slack about their last place",
        CountedBy::SEARCH},
       {MoverCounter::PAIRS_TOUCHED, "pairs_touched",
        "pairs of objects whose bounds were placed or whose room was used up", CountedBy::SEARCH},
       {MoverCounter::PAIRS_SEARCHED, "pairs_searched", "pairs of objects whose meshes were searched",
        CountedBy::SEARCH}});
  return description;
}

}  // namespace lmdbench
