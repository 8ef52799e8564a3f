// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/layout/wide_hierarchy.h>

#include <cstddef>
#include <vector>

/// Bounds of the eight sets of features under a node, found side by side: every set is a lane of the vectors,
/// and the same steps are done for all of them at once. Single precision is enough to choose axes and centres
/// by; what is stored as a bound is measured from them in double precision. The numbers do not depend on the
/// processor: only operations that are exact to rounding are used.
namespace lmdbench {

/// A vector of each lane.
struct LaneVectors {
  alignas(32) float x[WIDE_WIDTH];
  alignas(32) float y[WIDE_WIDTH];
  alignas(32) float z[WIDE_WIDTH];
};

/// Vectors of the sets, `count` of each: vector k of lane l stands at k * WIDE_WIDTH + l. Shorter sets repeat
/// one of theirs, lanes without a set hold what they like.
struct LaneSets {
  std::size_t count = 0;
  std::vector<float> x, y, z;

  /// Makes room; what was there is left as it is.
  void resize(std::size_t vectors);
  void set(std::size_t k, std::size_t lane, const Vec3& v) {
    const std::size_t at = k * WIDE_WIDTH + lane;
    x[at] = static_cast<float>(v.x());
    y[at] = static_cast<float>(v.y());
    z[at] = static_cast<float>(v.z());
  }
};

/// Circular cones around directions; as LaneSets.
struct LaneCaps {
  LaneSets axes;
  std::vector<float> cosines, sines;

  void resize(std::size_t caps);
};

/// Axes of circular cones around all caps of each lane, nearly the smallest: `steps` steps from the mean axis
/// towards the cap that sticks out most (M. Badoiu, K. Clarkson, "Smaller core-sets for balls", 2003, on the
/// sphere). No number where the mean axis is zero.
void find_lane_axes(const LaneCaps& caps, int steps, LaneVectors& axes);

/// Centres of disc-like bodies that hold all points of each lane: they halve the points' extent along the
/// lane's axis, and across it they are nearly the centre of the smallest sphere, as above.
/// @param axes unit up to rounding, or zero for none
void find_lane_centres(const LaneSets& points, const LaneVectors& axes, int steps, LaneVectors& centres);

}  // namespace lmdbench
