// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/drivers/direction_memory.h>

#include <limits>

namespace lmdbench {

std::int64_t DirectionMemory::complete(LmdSet& lmds) {
  LMDBENCH_EXPECTS(cutoff_ > 0.0, "a cutoff that was not checked");
  std::int64_t without_direction = 0;
  const double limit = is_older_ ? cutoff_ : std::numeric_limits<double>::infinity();
  known_.clear();
  for (Lmd& lmd : lmds) {
    // Tracking keeps the direction of triangles that intersect since: it is not this frame's.
    if (lmd.intersecting || lmd.direction.hasNaN()) ++without_direction;
    if (lmd.direction.hasNaN()) {
      double nearest_squared = limit * limit;
      for (const Lmd& earlier : last_) {
        if (earlier.fixed_body != lmd.fixed_body) continue;
        const double squared_distance = (earlier.point_fixed - lmd.point_fixed).squaredNorm();
        if (same_feature_pair(earlier, lmd) && squared_distance < limit * limit) {
          lmd.direction = earlier.direction;
          break;
        }
        if (squared_distance < nearest_squared) {
          nearest_squared = squared_distance;
          lmd.direction = earlier.direction;
        }
      }
    }
    if (!lmd.direction.hasNaN()) known_.push_back(lmd);
  }
  is_older_ = known_.empty();
  if (!known_.empty()) last_.swap(known_);
  return without_direction;
}

}  // namespace lmdbench
