// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/minimum_distance.h>
#include <lmdbench/world/nearest_instance.h>

namespace lmdbench {

NearestInstance nearest_instance(const Scene& scene, const BroadPhase& phase, const Pose& X_WM,
                                 double bound) {
  NearestInstance nearest;
  nearest.distance = bound;
  phase.by_distance(X_WM, [&](std::uint32_t instance, double at_least) {
    if (at_least > nearest.distance) return false;
    const Body& fixed = *scene.fixed[instance];
    const NearestPair pair = nearest_pair(scene.moving->surface(), scene.moving->prepared<Hierarchy>(),
                                          fixed.surface(), fixed.prepared<Hierarchy>(),
                                          relative_pose(phase.pose_of(instance), X_WM), nearest.distance);
    if (pair.triangle_moving < 0 || !(pair.distance <= nearest.distance)) return true;
    const auto index = static_cast<std::int32_t>(instance);
    if (nearest.instance < 0 || pair.distance < nearest.distance || index < nearest.instance)
      nearest.instance = index;
    nearest.distance = pair.distance;
    return true;
  });
  if (nearest.instance < 0) nearest.distance = std::numeric_limits<double>::infinity();
  return nearest;
}

}  // namespace lmdbench
