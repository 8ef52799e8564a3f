// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/force/aggregate.h>
#include <lmdbench/geometry/types.h>
#include <lmdbench/phantom/device.h>

#include <algorithm>

namespace lmdbench {

/// What the device gives to the hand for one commanded wrench.
struct RenderedForce {
  Vec3 force = Vec3::Zero();  ///< World frame, newtons; never longer than the device's largest force.
  bool clipped = false;       ///< The commanded force was longer than the limit.
  bool exceeds_continuous_force = false;  ///< The rendered force is above what the motors stand for long.
};

/// The virtual PHANTOM in open loop: it renders the force that it is commanded in the same tick and does not
/// move the scene; poses come from a path. Device and world axes coincide. Torque is not rendered: three
/// actuated degrees of freedom (paper, section 5).
class VirtualPhantom {
 public:
  explicit VirtualPhantom(const Device& device) : VirtualPhantom(device, device.maximum_force.value) {}

  /// @param clip limit of the rendered force [N] where it is below the device's own
  VirtualPhantom(const Device& device, double clip)
      : device_(device), limit_(std::min(clip, device.maximum_force.value)) {}

  const Device& device() const { return device_; }
  double limit() const { return limit_; }  ///< Largest rendered force [N].

  /// Clips the length of the summed force to the limit, keeping its direction (paper,
  /// section 4.5; decision E10, ours: the length of the sum is clipped, not the components and not the single
  /// LMDs). NaN stays NaN.
  RenderedForce render(const Wrench& command) const;

 private:
  Device device_;
  double limit_;
};

}  // namespace lmdbench
