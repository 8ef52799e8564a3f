// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/aggregation.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/phantom/device.h>

#include <algorithm>
#include <limits>

namespace lmdbench {

/// Output of the device to the hand for one commanded wrench.
struct RenderedForce {
  Vec3 force = Vec3::Zero();  ///< World frame, newtons; at most the device's largest force.
  /// World frame, newton metres, about the mesh's centre; zero of a device that renders none.
  Vec3 torque = Vec3::Zero();
  bool clipped = false;                   ///< The commanded force was longer than the limit.
  bool torque_clipped = false;            ///< The commanded torque was longer than the limit.
  bool exceeds_continuous_force = false;  ///< The motors cannot hold the rendered force for long.
};

/// The virtual PHANTOM in open loop: it renders the commanded force in the same tick and does not
/// move the scene; poses come from a path. Device and world axes coincide.
class VirtualPhantom {
 public:
  explicit VirtualPhantom(const Device& device) : device_(device) {}

  const Device& device() const { return device_; }

  /// Largest rendered force [N] of a sum that the profile clips to `largest_sum`.
  double limit(double largest_sum) const { return std::min(largest_sum, device_.maximum_force.value); }

  /// Clips the length of the summed force to the limit where it is longer by more than rounding
  /// (1e-12 of it), keeping its direction (paper, section 4.5;
  /// decision E10, ours: clips the sum, not its components and not single LMDs). NaN stays NaN. The
  /// torque is clipped likewise, to the device's largest: other motors render it. A device without
  /// that figure actuates three degrees of freedom and renders no torque (paper, section 5).
  /// @param largest_sum the force profile's own limit [N]
  RenderedForce render(const Wrench& command,
                       double largest_sum = std::numeric_limits<double>::infinity()) const;

 private:
  Device device_;
};

}  // namespace lmdbench
