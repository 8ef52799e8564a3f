// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/phantom/axis_triple.h>

namespace lmdbench {

/// The device's place, which hand, push and rendered force move between servo ticks: three equal, independent axes along the world's.
/// How it turns, where it actuates torque, is simulated_gimbal.h's.
class SimulatedDevice {
 public:
  /// Starts at rest.
  /// @param start_W     position [m], also of the meant path
  /// @param push_W      constant force [N]
  /// @param resolution  of the encoders [m]; 0: exact
  /// @param period      servo period [s]
  SimulatedDevice(const DeviceDynamics& dynamics, double period, const Vec3& start_W, const Vec3& push_W,
                  double resolution);

  /// One servo period with this force rendered all along (zero-order hold), while the meant path goes
  /// straight to its next position. Without a hand nothing is drawn along the path.
  void advance(const Vec3& rendered_W, const Vec3& next_path_position_W);

  Vec3 position() const { return path_position_W_ + axes_.offset(); }  ///< True position [m].
  Vec3 velocity() const { return axes_.velocity(); }                   ///< [m/s]
  Vec3 sensed_position() const;  ///< What the encoders tell: each axis rounded to the resolution [m].
  EnergyAccount energy() const { return axes_.energy(); }

  /// A blow: changes the velocity at once, as work of the push.
  void strike(const Vec3& velocity_change_W) { axes_.strike(velocity_change_W); }

 private:
  AxisTriple axes_;
  Vec3 path_position_W_;
  bool has_hand_;
  double period_;
  double resolution_;
};

}  // namespace lmdbench
