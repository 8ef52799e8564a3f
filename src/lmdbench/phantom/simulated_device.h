// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/phantom/axis_triple.h>

#include <Eigen/Geometry>

namespace lmdbench {

/// The device's position, which hand, push and rendered force move between servo ticks: three
/// equal, independent axes along the world's. SimulatedGimbal turns it where it actuates torque.
class SimulatedDevice {
 public:
  /// Starts at rest.
  /// @param start_W     position [m], also of the meant path
  /// @param push_W      constant force [N]
  /// @param resolution  of the encoders [m]; 0: exact
  /// @param period      servo period [s]
  SimulatedDevice(const DeviceDynamics& dynamics, double period, const Vec3& start_W, const Vec3& push_W,
                  double resolution);

  /// One servo period with this force rendered throughout (zero-order hold), while the meant path
  /// goes straight to its next position. Without a hand the path has no effect.
  void advance(const Vec3& rendered_W, const Vec3& next_path_position_W);

  Vec3 position() const { return path_position_W_ + axes_.offset(); }  ///< True position [m].
  Vec3 velocity() const { return axes_.velocity(); }                   ///< [m/s]
  Vec3 sensed_position() const;  ///< From the encoders: each axis rounded to the resolution [m].
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

/// Orientation of a device that actuates torque: hand, friction and torque turn it between ticks.
///
/// Model, ours: a gimbal whose joint coordinates are the components of the rotation vector y from
/// the meant path's orientation, R = exp(y) R_path, each an axis of axis_model.h with an inertia as
/// mass: linear equations, exact solution, closed energies. Against a rigid body of that inertia
/// this is exact for turns about one axis, else second order in y, which the hand's spring keeps
/// small. Without a hand, beyond half a turn, it is a gimbal, no free body.
///
/// The rendered torque t acts as J(y)^T t, of the same work (angular velocity w = J(y) y'): what
/// conserves energy in the world does so here. Energies are the gimbal's: where the path turns too,
/// work is by its coordinates' rates, whose share of the path's turn is right to first order in y.
/// The path turns at a constant rate between ticks.

/// A world torque on the coordinates y: J(y)^T torque, J the left Jacobian of the rotation vector.
Vec3 generalised_torque(const Vec3& rotation_vector, const Vec3& torque_W);

class SimulatedGimbal {
 public:
  /// Starts at rest.
  /// @param dynamics    inertia as mass [kg m^2], damping [N m s], friction [N m], hand likewise
  /// @param start       orientation R_WM, also of the meant path
  /// @param push_W      constant torque on the coordinates [N m]
  /// @param resolution  of the encoders [rad]; 0: exact
  /// @param period      servo period [s]
  SimulatedGimbal(const DeviceDynamics& dynamics, double period, const Eigen::Quaterniond& start,
                  const Vec3& push_W, double resolution);

  /// One servo period with this torque rendered throughout, while the meant path turns to its next
  /// orientation. Without a hand the path has no effect.
  void advance(const Vec3& torque_W, const Eigen::Quaterniond& next_path_orientation);

  Eigen::Quaterniond orientation() const;  ///< True R_WM.
  /// From the encoders: rotation vector from the start, each component rounded to the resolution.
  Eigen::Quaterniond sensed_orientation() const;
  Vec3 offset() const { return axes_.offset(); }  ///< y [rad]
  /// Of the device, world frame [rad/s]; where it jumps with the path's, the one before.
  Vec3 angular_velocity() const;
  EnergyAccount energy() const { return axes_.energy(); }

  /// A blow: changes the angular velocity at once, as work of the push.
  void strike(const Vec3& change_W) { axes_.strike(change_W); }

 private:
  AxisTriple axes_;
  Eigen::Quaterniond start_;
  Eigen::Quaterniond path_orientation_;
  bool has_hand_;
  double period_;
  double resolution_;
};

}  // namespace lmdbench
