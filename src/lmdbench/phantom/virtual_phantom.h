// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/aggregation.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/phantom/device.h>

#include <algorithm>
#include <limits>

namespace lmdbench {

/// What the device gives to the hand for one commanded wrench.
struct RenderedForce {
  Vec3 force = Vec3::Zero();  ///< World frame, newtons; never longer than the device's largest force.
  Vec3 torque = Vec3::
      Zero();  ///< World frame, newton metres, about the mesh's centre; zero of a device that renders none.
  bool clipped = false;                   ///< The commanded force was longer than the limit.
  bool torque_clipped = false;            ///< The commanded torque was longer than the limit.
  bool exceeds_continuous_force = false;  ///< The rendered force is above what the motors stand for long.
};

/// The virtual PHANTOM in open loop: it renders the force that it is commanded in the same tick and does not
/// move the scene; poses come from a path. Device and world axes coincide.
class VirtualPhantom {
 public:
  explicit VirtualPhantom(const Device& device) : device_(device) {}

  const Device& device() const { return device_; }

  /// Largest rendered force [N] of a sum that the profile clips to `largest_sum`.
  double limit(double largest_sum) const { return std::min(largest_sum, device_.maximum_force.value); }

  /// Clips the length of the summed force to the limit, keeping its direction (paper,
  /// section 4.5; decision E10, ours: the length of the sum is clipped, not the components and not the single
  /// LMDs). NaN stays NaN. The torque is clipped likewise, to the device's largest: other motors render it. A device without a figure
  /// for it actuates three degrees of freedom and renders none (paper, section 5).
  /// @param largest_sum the force profile's own limit [N]
  RenderedForce render(const Wrench& command,
                       double largest_sum = std::numeric_limits<double>::infinity()) const;

 private:
  Device device_;
};

}  // namespace lmdbench
