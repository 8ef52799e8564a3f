// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/phantom/virtual_phantom.h>

#include <cmath>

namespace lmdbench {
namespace {

/// The force of one contact at F_max is as long as F_max to rounding.
bool exceeds(double length, double limit) {
  constexpr double ROUNDING = 1e-12;
  return length > limit * (1.0 + ROUNDING);
}

}  // namespace

RenderedForce VirtualPhantom::render(const Wrench& command, double largest_sum) const {
  RenderedForce rendered;
  const double commanded_length = command.force.stableNorm();
  const double largest = limit(largest_sum);
  LMDBENCH_EXPECTS(!(largest < 0.0), "a limit with a sign");
  rendered.clipped = exceeds(commanded_length, largest);
  rendered.force = rendered.clipped ? Vec3((command.force / commanded_length) * largest) : command.force;
  rendered.exceeds_continuous_force =
      exceeds(rendered.clipped ? largest : commanded_length, device_.continuous_force.value);
  LMDBENCH_ENSURES(std::isnan(commanded_length) || rendered.force.norm() <= largest * (1.0 + UNIT_TOLERANCE),
                   "a force whose length overflows");
  const double largest_torque = device_.torque.value;
  if (std::isnan(largest_torque)) return rendered;
  const double torque_length = command.torque.stableNorm();
  rendered.torque_clipped = exceeds(torque_length, largest_torque);
  rendered.torque =
      rendered.torque_clipped ? Vec3((command.torque / torque_length) * largest_torque) : command.torque;
  return rendered;
}

}  // namespace lmdbench
