// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/snch/minimum_distance.h>

namespace lmdbench {

/// Exact nearest pairs of two meshes along a path. Each search begins with the last one's triangles at the new pose
/// as its bound, which changes nothing but the time: the least distance is the same bits as from scratch, of pairs
/// at equal distance another one may be named. Remembers its last pair, so use it from one thread.
class NearestTracker {
 public:
  /// The meshes and hierarchies must outlive this.
  NearestTracker(const Surface& moving, const Hierarchy& moving_hierarchy, const Surface& fixed,
                 const Hierarchy& fixed_hierarchy)
      : moving_(moving),
        fixed_(fixed),
        moving_hierarchy_(moving_hierarchy),
        fixed_hierarchy_(fixed_hierarchy) {}

  /// As `nearest_pair` without a bound.
  NearestPair nearest(const Pose& X_WM);

  /// The last pair at another pose; triangle_moving is -1 before the first search.
  NearestPair last_pair(const Pose& X_WM) const;

 private:
  const Surface& moving_;
  const Surface& fixed_;
  const Hierarchy& moving_hierarchy_;
  const Hierarchy& fixed_hierarchy_;
  std::int32_t last_moving_ = -1;
  std::int32_t last_fixed_ = -1;
};

}  // namespace lmdbench
