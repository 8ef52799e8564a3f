// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/phantom/axis_model.h>

#include <fmt/format.h>

#include <cmath>

namespace lmdbench {
namespace {

void require(bool sound, const char* name, double value, const char* remedy) {
  if (!sound) throw UsageError("", name, fmt::format("{} is not usable", value), remedy);
}

void check(const DeviceDynamics& dynamics) {
  require(std::isfinite(dynamics.mass_kg) && dynamics.mass_kg > 0.0, "mass_kg", dynamics.mass_kg,
          "give a mass above 0");
  const auto not_negative = [](const char* name, double value) {
    require(std::isfinite(value) && value >= 0.0, name, value, "give a finite number of at least 0");
  };
  not_negative("damping_n_s_per_m", dynamics.damping_n_s_per_m);
  not_negative("friction_n", dynamics.friction_n);
  if (!dynamics.hand) return;
  const Hand& hand = *dynamics.hand;
  not_negative("hand/mass_kg", hand.mass_kg);
  not_negative("hand/damping_n_s_per_m", hand.damping_n_s_per_m);
  not_negative("hand/stiffness_n_per_m", hand.stiffness_n_per_m);
  not_negative("hand/grip_damping_n_s_per_m", hand.grip_damping_n_s_per_m);
  not_negative("hand/grip_stiffness_n_per_m", hand.grip_stiffness_n_per_m);
  if (hand.has_grip())
    require(hand.mass_kg > 0.0, "hand/mass_kg", hand.mass_kg, "a hand behind a grip needs a mass above 0");
}

/// A linear function of the state.
AxisState row(std::initializer_list<std::pair<AxisSlot, double>> entries) {
  AxisState result = AxisState::Zero();
  for (const auto& [slot, value] : entries) at(result, slot) = value;
  return result;
}

/// The quadratic form of the product of two linear functions.
AxisMatrix product(const AxisState& a, const AxisState& b) {
  return 0.5 * (a * b.transpose() + b * a.transpose());
}

void set_row(AxisMatrix& matrix, AxisSlot slot, const AxisState& values) {
  matrix.row(static_cast<int>(slot)) = values.transpose();
}

}  // namespace

AxisModel make_axis_model(const DeviceDynamics& dynamics) {
  using enum AxisSlot;
  check(dynamics);
  const Hand hand = dynamics.hand.value_or(Hand{});
  const bool grip = hand.has_grip();
  const double b = dynamics.damping_n_s_per_m;

  const AxisState y = row({{POSITION, 1.0}});
  const AxisState v = row({{VELOCITY, 1.0}});
  const AxisState y_hand = grip ? row({{HAND_POSITION, 1.0}}) : y;
  const AxisState v_hand = grip ? row({{HAND_VELOCITY, 1.0}}) : v;
  const AxisState u = row({{PATH_VELOCITY, 1.0}});

  // Forces, linear in the state: of the person on the hand's mass, of the grip on the device.
  const AxisState person = -hand.stiffness_n_per_m * y_hand - hand.damping_n_s_per_m * (v_hand - u);
  const AxisState through_grip =
      -hand.grip_stiffness_n_per_m * (y - y_hand) - hand.grip_damping_n_s_per_m * (v - v_hand);
  const AxisState inputs = row({{RENDERED_FORCE, 1.0}, {PUSH, 1.0}, {FRICTION_FORCE, 1.0}});
  const AxisState on_device = inputs - b * v + (grip ? through_grip : person);
  const double device_mass = dynamics.mass_kg + (grip ? 0.0 : hand.mass_kg);

  AxisModel model;
  model.friction_n = dynamics.friction_n;
  model.slipping.setZero();
  set_row(model.slipping, POSITION, v - u);
  set_row(model.slipping, VELOCITY, on_device / device_mass);
  if (grip) {
    set_row(model.slipping, HAND_POSITION, v_hand - u);
    set_row(model.slipping, HAND_VELOCITY, (person - through_grip) / hand.mass_kg);
  }
  model.stuck = model.slipping;
  set_row(model.stuck, VELOCITY, AxisState::Zero());

  model.standing_force = on_device;
  at(model.standing_force, VELOCITY) = 0.0;
  at(model.standing_force, FRICTION_FORCE) = 0.0;

  const auto power = [&](EnergyFlow flow) -> AxisMatrix& {
    return model.power[static_cast<std::size_t>(flow)];
  };
  power(EnergyFlow::RENDERED) = product(row({{RENDERED_FORCE, 1.0}}), v);
  power(EnergyFlow::PUSH) = product(row({{PUSH, 1.0}}), v);
  power(EnergyFlow::HAND) = product(person, u);
  power(EnergyFlow::DAMPED) = b * product(v, v) + hand.damping_n_s_per_m * product(v_hand - u, v_hand - u);
  if (grip) power(EnergyFlow::DAMPED) += hand.grip_damping_n_s_per_m * product(v - v_hand, v - v_hand);
  power(EnergyFlow::FRICTION) = -product(row({{FRICTION_FORCE, 1.0}}), v);

  model.kinetic = device_mass * product(v, v);
  model.spring = hand.stiffness_n_per_m * product(y_hand, y_hand);
  if (grip) {
    model.kinetic += hand.mass_kg * product(v_hand, v_hand);
    model.spring += hand.grip_stiffness_n_per_m * product(y - y_hand, y - y_hand);
  }
  return model;
}

}  // namespace lmdbench
