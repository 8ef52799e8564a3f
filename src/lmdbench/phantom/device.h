// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace lmdbench {

/// Reliability of a device figure.
enum class Trust : std::uint8_t {
  STATED,       ///< Read in the named source, for this device or its renamed successor.
  FROM_MEMORY,  ///< Recalled, not re-read; good enough to start from, not to quote.
  DEFINED,      ///< True by definition: the ideal device's.
  UNKNOWN       ///< No figure was found: the value is NaN.
};

/// One figure of a device, with its source.
struct DeviceFigure {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< in `unit`
  std::string_view unit;                                    ///< SI symbol
  std::string_view source;
  Trust trust = Trust::UNKNOWN;
};

/// A haptic device. All sense position and orientation and render a translational force (paper,
/// section 5); those with a figure for the torque can render that as well (`/loop/actuated`).
struct Device {
  std::string_view name;   ///< As written in experiments, e.g. "phantom-desktop".
  std::string_view title;  ///< As written in reports.

  DeviceFigure maximum_force;        ///< Largest force, for moments [N]: the limit of decision E10.
  DeviceFigure continuous_force;     ///< Force that the motors can hold for long [N].
  DeviceFigure position_resolution;  ///< Nominal [m].
  DeviceFigure apparent_mass;        ///< At the stylus [kg].
  DeviceFigure damping;              ///< Viscous damping of the mechanism [N s/m].
  DeviceFigure friction;             ///< Back-drive friction [N].
  DeviceFigure torque;  ///< Largest torque [N m], if actuated; only a continuous one is published.
};

/// All known devices, in a fixed order.
std::span<const Device> known_devices();

/// Device of that name.
/// @param file, pointer the place that the name was read from, for the message
/// @throws UsageError listing the known names
const Device& device_named(std::string_view name, std::string_view file = "", std::string_view pointer = "");

}  // namespace lmdbench
