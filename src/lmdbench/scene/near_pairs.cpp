// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/scene/mesh_bounds.h>
#include <lmdbench/scene/near_pairs.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace lmdbench {
namespace {

/// Calls visit(object, bounds); a look-up costs a lock, and instances follow each other.
template <class Visit>
void for_each_object(const Scene& scene, Visit&& visit) {
  const Body* last = nullptr;
  const MeshBounds* bounds = nullptr;
  for (std::size_t i = 0; i < scene.object_count(); ++i) {
    const Body& body = *scene.body(i);
    if (std::exchange(last, &body) != &body) bounds = &body.prepared<MeshBounds>();
    visit(i, *bounds);
  }
}

}  // namespace

double contact_reach(const Scene& scene) {
  double of_movers = 0.0, of_others = 0.0;
  for_each_object(scene, [&](std::size_t object, const MeshBounds& bounds) {
    if (scene.is_mover(object)) of_movers = std::max(of_movers, bounds.known);
    if (!scene.is_mover(object) || scene.several_move()) of_others = std::max(of_others, bounds.known);
  });
  return scene.cutoff + 2.0 * (of_movers + of_others);
}

const std::vector<NearPairs::Pair>& NearPairs::within(double distance, const Pose& X_WM) {
  pairs_.clear();
  centres_.clear();
  radii_.clear();
  rounding_.clear();
  for_each_object(scene_, [&](std::size_t object, const MeshBounds& bounds) {
    const RigidTransform X_WB(scene_.pose(object, X_WM));
    centres_.push_back(X_WB.point(bounds.centre));
    radii_.push_back(bounds.radius);
    rounding_.push_back(4.0 * PLACING_ROUNDING * bounds.coordinates(X_WB));
  });
  for (std::uint32_t mover = 0; mover < scene_.mover_count(); ++mover)
    for (std::uint32_t other = mover + 1; other < centres_.size(); ++other) {
      const double between = (centres_[mover] - centres_[other]).norm() - radii_[mover] - radii_[other] -
                             rounding_[mover] - rounding_[other];
      if (between <= distance) pairs_.push_back({std::max(between, 0.0), {mover, other}});
    }
  std::ranges::sort(pairs_, {}, [](const Pair& pair) { return std::tie(pair.at_least, pair.objects); });
  return pairs_;
}

}  // namespace lmdbench
