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

/// Two minima joined by a path on which no distance exceeds a saddle's: from that level on the
/// components of {distance <= t} that hold them are one, if they were not before.
struct Merge {
  std::size_t saddle = 0;             ///< Into the critical set.
  std::size_t first = 0, second = 0;  ///< Into the critical set; CriticalPair::is_basin.
};

/// Ends of descents, by fixed body and the pair of triangles that they began at.
using Descents = std::map<std::array<std::int32_t, 3>, std::size_t>;

/// Minima that a critical set's saddles join: from each saddle a descent over pairs of triangles
/// into every direction down, that is, a pair of its triangles on which the (convex) distance
/// falls. Works at generic_pose, as indices do. Descents to no minimum of the set join nothing.
class MergeFinder {
 public:
  explicit MergeFinder(Scene scene) : scene_(std::move(scene)) {}

  /// @param merges  sorted by the saddle's distance
  void find(const Pose& X_WM, const CriticalSet& critical, std::vector<Merge>& merges);

  static constexpr std::size_t NO_MINIMUM = std::numeric_limits<std::size_t>::max();
  /// Where a descent ends, into the critical set, or NO_MINIMUM. Keeps ends since the last `find`.
  /// @param X_WM  generic_pose of the pose of `find`
  /// @pre `find` was called for this pose and these critical pairs
  std::size_t end_of_descent(const RigidTransform& X_WM, const CriticalSet& critical, std::int32_t body,
                             std::int32_t t_moving, std::int32_t t_fixed);

  std::uint64_t triangle_distances() const { return triangle_distances_; }  ///< Of all calls.

 private:
  Scene scene_;
  Descents ended_;
  std::uint64_t triangle_distances_ = 0;
};

}  // namespace lmdbench
