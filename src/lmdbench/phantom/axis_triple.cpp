// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/axis_triple.h>

#include <cstddef>

namespace lmdbench {

EnergyAccount& EnergyAccount::operator+=(const EnergyAccount& other) {
  kinetic += other.kinetic;
  spring += other.spring;
  rendered += other.rendered;
  push += other.push;
  hand += other.hand;
  damped += other.damped;
  friction += other.friction;
  moved += other.moved;
  return *this;
}

AxisTriple::AxisTriple(const DeviceDynamics& dynamics, double period, const Vec3& push)
    : model_(make_axis_model(dynamics)), integrator_(model_, period) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    states_[axis].setZero();
    at(states_[axis], AxisSlot::PUSH) = push[static_cast<int>(axis)];
  }
}

void AxisTriple::advance(const Vec3& rendered, const Vec3& path_velocity) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    AxisState& state = states_[axis];
    at(state, AxisSlot::RENDERED_FORCE) = rendered[static_cast<int>(axis)];
    at(state, AxisSlot::PATH_VELOCITY) = path_velocity[static_cast<int>(axis)];
    EnergyFlows flows = EnergyFlows::Zero();
    integrator_.advance(state, flows);
    flows_ += flows;
    moved_ += flows.cwiseAbs().sum();
  }
}

void AxisTriple::strike(const Vec3& velocity_change) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double before = model_.stored(states_[axis]).kinetic;
    at(states_[axis], AxisSlot::VELOCITY) += velocity_change[static_cast<int>(axis)];
    const double work = model_.stored(states_[axis]).kinetic - before;
    at(flows_, EnergyFlow::PUSH) += work;
    moved_ += std::abs(work);
  }
}

Vec3 AxisTriple::at_each(AxisSlot slot) const {
  Vec3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) result[static_cast<int>(axis)] = at(states_[axis], slot);
  return result;
}

EnergyAccount AxisTriple::energy() const {
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

}  // namespace lmdbench
