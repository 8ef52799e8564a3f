// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/records.h>
#include <lmdbench/prepare/driver_input.h>

#include <optional>
#include <vector>

/// Whether contacts give energy (a passivity observer: Hannaford and Ryu, IEEE Transactions on
/// Robotics and Automation 18(1), 2002). Contacts work on all that they push. A device is one port;
/// with three actuated degrees of freedom the path turns the mesh, so this turn is another one.
namespace lmdbench {

/// What contacts work on in a run, beside the device.
struct ContactPorts {
  /// Point of the moving mesh about which torque is taken, if the path turns the mesh.
  std::optional<Vec3> turned_about_M = std::nullopt;
  bool others_move = false;  ///< Other meshes move or deform: the work on them is not known.
};

ContactPorts contact_ports(const DriverInput& input);

/// Net work of the contacts since the start [J], one a frame. Contacts that begin apart and only
/// store and lose energy never give any: the work stays at or below zero. Of contacts there from
/// the start it may reach what these store. Forces are those rendered, torque on the path's turn is
/// that before clipping. Empty in an open loop and where others move.
std::vector<double> contact_work(const MethodRecord& record, const ContactPorts& ports);

}  // namespace lmdbench
