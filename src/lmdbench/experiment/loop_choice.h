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

/// How the device turns where it actuates torque as well (simulated_device.h).
struct RotationChoice {
  DeviceDynamics
      dynamics;  ///< Inertia [kg m^2] in the place of mass, damping [N m s], friction [N m], hand likewise.
  double resolution_rad = 0.0;  ///< Of the encoders; 0: exact.
};

/// Where poses come from: `/loop` of an experiment. In an open loop from the path; in a closed one from the simulated
/// device, which the rendered force moves, while a hand, where there is one, draws it along the path.
struct LoopChoice {
  bool closed = false;
  DeviceDynamics dynamics;
  double resolution_m = 0.0;      ///< Of the encoders; 0: exact.
  std::int64_t delay_frames = 0;  ///< The force of frame n is rendered from frame n + delay_frames on.
  Vec3 push_n = Vec3::Zero();     ///< A constant force on the device, world frame.
  /// Set: six actuated degrees of freedom. Unset: three, and the orientation is the path's.
  std::optional<RotationChoice> rotation = std::nullopt;
};

/// Reads `/loop`. What it does not give of the device's mass, damping, friction and resolution is taken from the
/// device and written into `entry`, so that the resolved experiment holds every figure in use. What it does not give of the
/// rotation, for which nobody publishes figures, is that of the translation at a lever arm (ours): inertia m l^2, damping b l^2,
/// friction f l, resolution r / l; the hand likewise.
/// @param entry the checked object, with the schema's defaults
/// @throws UsageError naming the JSON pointer: unknown hand, figures that make no device, six degrees of freedom of a
///         device that renders no torque
LoopChoice loop_choice(nlohmann::json& entry, const Device& device, const std::string& file);

}  // namespace lmdbench
