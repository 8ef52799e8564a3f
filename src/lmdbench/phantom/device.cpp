// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/phantom/device.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

constexpr std::string_view SURVEY = "survey of the makers' data sheets (secondary)";
constexpr std::string_view CHAI3D = "CHAI3D, src/devices/CPhantomDevices.cpp";
constexpr double NO_LIMIT = std::numeric_limits<double>::infinity();

/// The only known damping of a PHANTOM; the other devices' mechanisms are assumed to have the same.
constexpr DeviceFigure MECHANISM_DAMPING = {
    0.005, "N s/m", "Diolaiti et al., T-RO 22(2), 2006, of a PHANToM 1.0, not re-read", Trust::FROM_MEMORY};

constexpr std::string_view RECALLED = "maker's data sheet, not re-read";

constexpr DeviceFigure survey(double value, std::string_view unit) {
  return {value, unit, SURVEY, Trust::STATED};
}
constexpr DeviceFigure chai3d(double value, std::string_view unit) {
  return {value, unit, CHAI3D, Trust::STATED};
}
constexpr DeviceFigure recalled(double value, std::string_view unit) {
  return {value, unit, RECALLED, Trust::FROM_MEMORY};
}
constexpr DeviceFigure defined(double value, std::string_view unit) {
  return {value, unit, "by definition", Trust::DEFINED};
}
constexpr DeviceFigure unknown(std::string_view unit) {
  return {std::numeric_limits<double>::quiet_NaN(), unit, "", Trust::UNKNOWN};
}

// Figures of the Desktop are those of its successor Touch X where the survey has only that name,
// the Omni's those of the Touch. Each has its source and trust; upper bounds of masses are marked.
constexpr std::array<Device, 6> DEVICES = {{
    {
        // No friction, encoder counts or force limit: the device of theory. Mass and damping are
        // those of the published stability boundary that the closed loop is compared with.
        .name = "ideal",
        .title = "ideal device",
        .maximum_force = defined(NO_LIMIT, "N"),
        .continuous_force = defined(NO_LIMIT, "N"),
        .position_resolution = defined(0.0, "m"),
        .apparent_mass = defined(0.04, "kg"),
        .damping = defined(0.8, "N s/m"),
        .friction = defined(0.0, "N"),
        .torque = defined(NO_LIMIT, "N m"),
    },
    {
        .name = "phantom-desktop",
        .title = "PHANTOM Desktop",
        .maximum_force = survey(7.9, "N"),
        .continuous_force = survey(1.75, "N"),
        .position_resolution = survey(0.023e-3, "m"),
        .apparent_mass = recalled(0.045, "kg"),
        .damping = MECHANISM_DAMPING,
        .friction = recalled(0.06, "N"),
        .torque = unknown("N m"),
    },
    {
        .name = "phantom-premium-1.5",
        .title = "PHANTOM Premium 1.5",
        .maximum_force = survey(8.5, "N"),
        .continuous_force = survey(1.4, "N"),
        .position_resolution = survey(0.03e-3, "m"),
        .apparent_mass = recalled(0.075, "kg"),  // an upper bound
        .damping = MECHANISM_DAMPING,
        .friction = recalled(0.04, "N"),
        .torque = unknown("N m"),
    },
    {
        .name = "phantom-premium-1.5-6dof",
        .title = "PHANTOM Premium 1.5 6DOF",
        .maximum_force = chai3d(8.5, "N"),
        .continuous_force = recalled(1.4, "N"),
        .position_resolution = recalled(0.03e-3, "m"),
        .apparent_mass = recalled(0.136, "kg"),  // an upper bound, the larger of two recalled
        .damping = MECHANISM_DAMPING,
        .friction = recalled(0.04, "N"),
        .torque = chai3d(0.188, "N m"),
    },
    {
        .name = "phantom-omni",
        .title = "PHANTOM Omni",
        .maximum_force = survey(3.3, "N"),
        .continuous_force = survey(0.88, "N"),
        .position_resolution = survey(0.055e-3, "m"),
        .apparent_mass = recalled(0.045, "kg"),
        .damping = MECHANISM_DAMPING,
        .friction = recalled(0.26, "N"),
        .torque = unknown("N m"),
    },
    {
        .name = "phantom-premium-3.0-6dof",
        .title = "PHANTOM Premium 3.0 6DOF",
        .maximum_force = chai3d(22.0, "N"),
        .continuous_force = recalled(3.0, "N"),
        .position_resolution = recalled(0.02e-3, "m"),
        .apparent_mass = recalled(0.159, "kg"),  // an upper bound
        .damping = MECHANISM_DAMPING,
        .friction = recalled(0.2, "N"),
        .torque = chai3d(0.188, "N m"),
    },
}};

}  // namespace

std::span<const Device> known_devices() {
  return DEVICES;
}

const Device& device_named(std::string_view name, std::string_view file, std::string_view pointer) {
  std::vector<std::string_view> names;
  for (const Device& device : DEVICES) {
    if (device.name == name) return device;
    names.push_back(device.name);
  }
  throw UsageError(std::string(file), std::string(pointer), fmt::format("there is no device '{}'", name),
                   fmt::format("use one of {}", fmt::join(names, ", ")));
}

}  // namespace lmdbench
