// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/phantom/axis_model.h>
#include <lmdbench/phantom/device.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace lmdbench {

/// Rotation of a device that actuates torque as well (simulated_device.h).
struct RotationChoice {
  /// Inertia [kg m^2] in place of mass, damping [N m s], friction [N m], hand likewise.
  DeviceDynamics dynamics;
  double resolution_rad = 0.0;  ///< Of the encoders; 0: exact.
};

/// Source of poses: `/loop` of an experiment. Open: the path. Closed: the simulated device, moved
/// by the rendered force and, where there is one, by a hand along the path.
struct LoopChoice {
  bool closed = false;
  DeviceDynamics dynamics;
  double resolution_m = 0.0;      ///< Of the encoders; 0: exact.
  std::int64_t delay_frames = 0;  ///< Frame n's force is rendered from frame n + delay_frames on.
  Vec3 push_n = Vec3::Zero();     ///< A constant force on the device, world frame.
  /// Set: six actuated degrees of freedom. Unset: three, and the orientation is the path's.
  std::optional<RotationChoice> rotation = std::nullopt;
};

/// Reads `/loop`. Missing mass, damping, friction and resolution are the device's, and are written
/// into `entry`, so that the resolved experiment holds every figure. Missing figures of rotation,
/// which nobody publishes, are the translation's at a lever arm l (ours): inertia m l^2, damping b
/// l^2, friction f l, resolution r / l; the hand likewise.
/// @param entry the checked object, with the schema's defaults
/// @throws UsageError naming the JSON pointer: unknown hand, impossible figures, six degrees of
///         freedom of a device that renders no torque
LoopChoice loop_choice(nlohmann::json& entry, const Device& device, const std::string& file);

}  // namespace lmdbench
