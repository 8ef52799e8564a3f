// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/critical_pair.h>
#include <lmdbench/lmd/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace lmdbench {

/// Two minima between which a way leads that is nowhere longer than a saddle: the components of {distance <= t} in which they lie
/// are one from that level on, if they were not before.
struct Merge {
  std::size_t saddle = 0;             ///< Into the critical set.
  std::size_t first = 0, second = 0;  ///< Into the critical set; of index 1 or more.
};

/// Where a descent ends, by fixed body and the pair of triangles that it began at.
using Descents = std::map<std::array<std::int32_t, 3>, std::size_t>;

/// Which minima the saddles of a critical set join: from every saddle one descent over pairs of triangles into each direction that leads
/// down (the distance is convex on a pair of triangles, so a pair of the saddle's triangles that is nearer than the saddle is such a direction).
/// Works at the pose at which indices are taken (generic_pose). A descent that ends at no minimum of the set joins nothing.
class MergeFinder {
 public:
  explicit MergeFinder(Scene scene) : scene_(std::move(scene)) {}

  /// @param merges  sorted by the saddle's distance
  void find(const Pose& X_WM, const CriticalSet& critical, std::vector<Merge>& merges);

  static constexpr std::size_t NO_MINIMUM = std::numeric_limits<std::size_t>::max();
  /// Where a descent from a pair of triangles ends: into the critical set, or NO_MINIMUM. Remembers descents since the last `find`.
  /// @param X_WM  generic_pose of the pose that `find` was asked for
  /// @pre `find` was asked for this pose and these critical pairs
  std::size_t end_of_descent(const RigidTransform& X_WM, const CriticalSet& critical, std::int32_t body,
                             std::int32_t t_moving, std::int32_t t_fixed);

  std::uint64_t triangle_distances() const { return triangle_distances_; }  ///< Of all calls.

 private:
  Scene scene_;
  Descents ended_;
  std::uint64_t triangle_distances_ = 0;
};

}  // namespace lmdbench
