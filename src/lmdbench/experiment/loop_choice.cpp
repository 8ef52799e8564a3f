// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/loop_choice.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

std::optional<Hand> hand_choice(const Json& entry, const std::string& file) {
  if (entry.is_null()) return std::nullopt;
  if (entry.is_string()) return hand_named(entry.get<std::string>(), file, "/loop/hand");
  Hand hand{"custom",
            entry["mass_kg"].get<double>(),
            entry["damping_n_s_per_m"].get<double>(),
            entry["stiffness_n_per_m"].get<double>(),
            entry["grip_damping_n_s_per_m"].get<double>(),
            entry["grip_stiffness_n_per_m"].get<double>()};
  if (hand.has_grip() && hand.mass_kg == 0.0)
    throw UsageError(file, "/loop/hand/mass_kg", "a hand behind a grip has no mass", "give a mass above 0");
  return hand;
}

/// The figure that the experiment gives, else the device's.
double figure(Json& entry, const char* key, const DeviceFigure& of_device) {
  if (!entry.contains(key)) entry[key] = of_device.value;
  return entry[key].get<double>();
}

}  // namespace

LoopChoice loop_choice(Json& entry, const Device& device, const std::string& file) {
  LoopChoice loop;
  loop.closed = entry["kind"] == "closed";
  loop.dynamics.mass_kg = figure(entry, "mass_kg", device.apparent_mass);
  loop.dynamics.damping_n_s_per_m = figure(entry, "damping_n_s_per_m", device.damping);
  loop.dynamics.friction_n = figure(entry, "friction_n", device.friction);
  loop.dynamics.hand = hand_choice(entry["hand"], file);
  loop.resolution_m = figure(entry, "resolution_m", device.position_resolution);
  loop.delay_frames = entry["delay_frames"].get<std::int64_t>();
  for (int axis = 0; axis < 3; ++axis)
    loop.push_n[axis] = entry["push_n"][static_cast<std::size_t>(axis)].get<double>();
  const auto names = integration_names();
  const auto chosen = std::find(names.begin(), names.end(), entry["integrator"].get<std::string>());
  loop.integration = static_cast<Integration>(chosen - names.begin());
  return loop;
}

}  // namespace lmdbench
