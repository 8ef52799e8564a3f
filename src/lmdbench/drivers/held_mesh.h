// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/loop_choice.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/phantom/simulated_device.h>
#include <lmdbench/phantom/virtual_phantom.h>

#include <optional>

namespace lmdbench {

/// The moving mesh on the simulated device of `/loop`. With three actuated degrees of freedom its
/// position is simulated and its orientation is the meant path's: nothing resists a turn. With six
/// both are simulated; the device holds the mesh at the point about which torque is taken.
class HeldMesh {
 public:
  /// Starts at rest.
  /// @param start        X_WM, also of the meant path
  /// @param reference_M  point about which torque is taken
  /// @param push_W, push_torque_W  constant force [N] and, with six degrees, torque [N m]
  HeldMesh(const LoopChoice& loop, double period, const Pose& start, const Vec3& reference_M,
           const Vec3& push_W, const Vec3& push_torque_W);

  /// One servo period with force and torque held, while the meant path goes to its next pose.
  void advance(const RenderedForce& held, const Pose& next_on_path);

  Pose pose() const;         ///< True X_WM.
  Pose sensed_pose() const;  ///< What the encoders tell.
  Vec3 velocity() const;     ///< Of the mesh's origin, world [m/s].
  EnergyAccount energy() const;

  /// The point of the mesh that the device holds: its place, its way from a place, its velocity.
  Vec3 held_position() const { return place_.position(); }
  Vec3 held_velocity() const { return place_.velocity(); }
  Vec3 turn() const;              ///< From the meant path [rad]; zero with three degrees.
  Vec3 angular_velocity() const;  ///< [rad/s]; zero with three degrees of freedom.

  /// A blow: changes the held point's velocities at once; the angular one only with six degrees.
  void strike(const Vec3& velocity_W, const Vec3& angular_velocity_W);

 private:
  SimulatedDevice place_;
  std::optional<SimulatedGimbal> gimbal_;
  Vec3 held_M_;  ///< The point that the device holds: the origin with three degrees of freedom.
  Eigen::Quaterniond path_orientation_;
};

}  // namespace lmdbench
