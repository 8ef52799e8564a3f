// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/simulated_device.h>

#include <cmath>
#include <cstddef>

namespace lmdbench {

SimulatedDevice::SimulatedDevice(const DeviceDynamics& dynamics, Integration integration, double period,
                                 const Vec3& start_W, const Vec3& push_W, double resolution)
    : model_(make_axis_model(dynamics)),
      path_position_W_(start_W),
      has_hand_(dynamics.hand.has_value()),
      period_(period),
      resolution_(resolution) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    integrators_[axis] = make_axis_integrator(integration, model_, period);
    states_[axis].setZero();
    at(states_[axis], AxisSlot::PUSH) = push_W[static_cast<int>(axis)];
  }
}

void SimulatedDevice::advance(const Vec3& rendered_W, const Vec3& next_path_position_W) {
  const Vec3 path_velocity_W =
      has_hand_ ? Vec3((next_path_position_W - path_position_W_) / period_) : Vec3(Vec3::Zero());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    AxisState& state = states_[axis];
    at(state, AxisSlot::RENDERED_FORCE) = rendered_W[static_cast<int>(axis)];
    at(state, AxisSlot::PATH_VELOCITY) = path_velocity_W[static_cast<int>(axis)];
    EnergyFlows flows = EnergyFlows::Zero();
    integrators_[axis]->advance(state, flows);
    flows_ += flows;
    moved_ += flows.cwiseAbs().sum();
  }
  if (has_hand_) path_position_W_ = next_path_position_W;
}

Vec3 SimulatedDevice::position() const {
  Vec3 result = path_position_W_;
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[static_cast<int>(axis)] += at(states_[axis], AxisSlot::POSITION);
  return result;
}

Vec3 SimulatedDevice::velocity() const {
  Vec3 result;
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[static_cast<int>(axis)] = at(states_[axis], AxisSlot::VELOCITY);
  return result;
}

Vec3 SimulatedDevice::sensed_position() const {
  Vec3 result = position();
  if (resolution_ > 0.0)
    for (int axis = 0; axis < 3; ++axis)
      result[axis] = std::nearbyint(result[axis] / resolution_) * resolution_;
  return result;
}

EnergyAccount SimulatedDevice::energy() const {
  EnergyAccount account;
  for (const AxisState& state : states_) {
    const StoredEnergy stored = model_.stored(state);
    account.kinetic += stored.kinetic;
    account.spring += stored.spring;
  }
  account.rendered = at(flows_, EnergyFlow::RENDERED);
  account.push = at(flows_, EnergyFlow::PUSH);
  account.hand = at(flows_, EnergyFlow::HAND);
  account.damped = at(flows_, EnergyFlow::DAMPED);
  account.friction = at(flows_, EnergyFlow::FRICTION);
  account.moved = moved_;
  return account;
}

void SimulatedDevice::strike(const Vec3& velocity_change_W) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double before = model_.stored(states_[axis]).kinetic;
    at(states_[axis], AxisSlot::VELOCITY) += velocity_change_W[static_cast<int>(axis)];
    const double work = model_.stored(states_[axis]).kinetic - before;
    at(flows_, EnergyFlow::PUSH) += work;
    moved_ += std::abs(work);
  }
}

}  // namespace lmdbench
