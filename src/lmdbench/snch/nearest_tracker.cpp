// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/snch/nearest_tracker.h>

#include <cmath>

namespace lmdbench {

NearestPair NearestTracker::last_pair(const Pose& X_WM) const {
  if (last_moving_ < 0) return {};
  const Triangle triangle_W = RigidTransform(X_WM).triangle(moving_.mesh.triangle(last_moving_));
  const TrianglePairDistance pair = triangle_distance(triangle_W, fixed_.mesh.triangle(last_fixed_));
  return {std::sqrt(pair.squared_distance), last_moving_, last_fixed_, pair};
}

NearestPair NearestTracker::nearest(const Pose& X_WM) {
  const NearestPair last = last_pair(X_WM);
  const double bound = last.triangle_moving < 0 ? std::numeric_limits<double>::infinity() : last.distance;
  const NearestPair found = nearest_pair(moving_, moving_hierarchy_, fixed_, fixed_hierarchy_, X_WM, bound);
  if (found.triangle_moving < 0) return last;  // nothing is nearer
  last_moving_ = found.triangle_moving;
  last_fixed_ = found.triangle_fixed;
  return found;
}

}  // namespace lmdbench
