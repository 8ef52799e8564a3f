// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/simulated_device.h>

#include <cmath>

namespace lmdbench {

SimulatedDevice::SimulatedDevice(const DeviceDynamics& dynamics, double period, const Vec3& start_W,
                                 const Vec3& push_W, double resolution)
    : axes_(dynamics, period, push_W),
      path_position_W_(start_W),
      has_hand_(dynamics.hand.has_value()),
      period_(period),
      resolution_(resolution) {}

void SimulatedDevice::advance(const Vec3& rendered_W, const Vec3& next_path_position_W) {
  const Vec3 path_velocity_W =
      has_hand_ ? Vec3((next_path_position_W - path_position_W_) / period_) : Vec3(Vec3::Zero());
  axes_.advance(rendered_W, path_velocity_W);
  if (has_hand_) path_position_W_ = next_path_position_W;
}

Vec3 SimulatedDevice::sensed_position() const {
  Vec3 result = position();
  if (resolution_ > 0.0)
    for (int axis = 0; axis < 3; ++axis)
      result[axis] = std::nearbyint(result[axis] / resolution_) * resolution_;
  return result;
}

}  // namespace lmdbench
