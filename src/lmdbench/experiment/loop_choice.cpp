// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/loop_choice.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

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

/// The experiment's figure, else the device's.
double figure(Json& entry, const char* key, const DeviceFigure& of_device) {
  if (!entry.contains(key)) entry[key] = of_device.value;
  return entry[key].get<double>();
}

/// The same hand at a lever arm, as figures of rotation.
std::optional<Hand> at_lever(const std::optional<Hand>& hand, double lever) {
  if (!hand) return std::nullopt;
  const double squared = lever * lever;
  return Hand{hand->name,
              hand->mass_kg * squared,
              hand->damping_n_s_per_m * squared,
              hand->stiffness_n_per_m * squared,
              hand->grip_damping_n_s_per_m * squared,
              hand->grip_stiffness_n_per_m * squared};
}

std::optional<RotationChoice> rotation_choice(Json& loop, const LoopChoice& translation, const Device& device,
                                              const std::string& file) {
  if (loop["actuated"] == 3) return std::nullopt;
  if (std::isnan(device.torque.value)) {
    std::vector<std::string_view> able;
    for (const Device& known : known_devices())
      if (!std::isnan(known.torque.value)) able.push_back(known.name);
    throw UsageError(file, "/loop/actuated", fmt::format("'{}' renders no torque", device.name),
                     fmt::format("let /device be one of {}, or actuate 3", fmt::join(able, ", ")));
  }
  Json& entry = loop["rotation"];
  const double lever = entry["lever_m"].get<double>();
  const auto figure_or = [&](const char* key, double otherwise) {
    if (!entry.contains(key)) entry[key] = otherwise;
    return entry[key].get<double>();
  };
  RotationChoice rotation;
  rotation.dynamics.mass_kg = figure_or("inertia_kg_m2", translation.dynamics.mass_kg * lever * lever);
  rotation.dynamics.damping_n_s_per_m =
      figure_or("damping_n_m_s", translation.dynamics.damping_n_s_per_m * lever * lever);
  rotation.dynamics.friction_n = figure_or("friction_n_m", translation.dynamics.friction_n * lever);
  rotation.resolution_rad = figure_or("resolution_rad", translation.resolution_m / lever);
  if (!entry.contains("hand")) {
    rotation.dynamics.hand = at_lever(translation.dynamics.hand, lever);
  } else if (const Json& hand = entry["hand"]; !hand.is_null()) {
    rotation.dynamics.hand = Hand{"custom", hand["inertia_kg_m2"].get<double>(),
                                  hand["damping_n_m_s"].get<double>(), hand["stiffness_n_m"].get<double>()};
  }
  return rotation;
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
  loop.rotation = rotation_choice(entry, loop, device, file);
  return loop;
}

}  // namespace lmdbench
