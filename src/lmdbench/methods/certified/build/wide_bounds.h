// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/methods/certified/layout/wide_hierarchy.h>

#include <cstddef>
#include <vector>

/// Bounds of the eight sets of features under a node, found side by side: each set is a lane of the
/// vectors. Axes and centres are chosen in single precision; the bounds that are stored are
/// measured from them in double precision. Only operations that are exact to rounding are used, so
/// the numbers do not depend on the processor.
namespace lmdbench {

/// A vector of each lane.
struct LaneVectors {
  alignas(32) float x[WIDE_WIDTH];
  alignas(32) float y[WIDE_WIDTH];
  alignas(32) float z[WIDE_WIDTH];
};

/// Vectors of the sets, `count` of each: vector k of lane l is at k * WIDE_WIDTH + l. Shorter sets
/// repeat a vector; lanes without a set hold any numbers.
struct LaneSets {
  std::size_t count = 0;
  std::vector<float> x, y, z;

  /// Makes room without clearing.
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

/// Axes of nearly the smallest circular cones around all caps of each lane: `steps` steps from the
/// mean axis towards the cap that sticks out most (M. Badoiu, K. Clarkson, "Smaller core-sets for
/// balls", 2003, on the sphere). Not a number where the mean axis is zero.
void find_lane_axes(const LaneCaps& caps, int steps, LaneVectors& axes);

/// Centres of disc-like bodies that hold all points of each lane: the middle of the points' extent
/// along the axis, and across it nearly the centre of the smallest sphere, as above.
/// @param axes unit up to rounding, or zero for none
void find_lane_centres(const LaneSets& points, const LaneVectors& axes, int steps, LaneVectors& centres);

}  // namespace lmdbench
