// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/odeint_integrators.h>
#include <lmdbench/phantom/smoothed_axis.h>

#include <cmath>

namespace lmdbench {

AxisState SmoothedAxis::with_friction(const Vector& x) const {
  AxisState state = x.head<AXIS_STATE_SIZE>();
  at(state, AxisSlot::FRICTION_FORCE) =
      -model_.friction_n * std::tanh(at(state, AxisSlot::VELOCITY) / SMOOTHING_SPEED);
  return state;
}

SmoothedAxis::Vector SmoothedAxis::rates(const Vector& x) const {
  const AxisState state = with_friction(x);
  Vector result;
  result.head<AXIS_STATE_SIZE>() = model_.slipping * state;
  for (std::size_t i = 0; i < ENERGY_FLOW_COUNT; ++i)
    result[AXIS_STATE_SIZE + static_cast<int>(i)] = state.dot(model_.power[i] * state);
  return result;
}

SmoothedAxis::Jacobian SmoothedAxis::jacobian(const Vector& x) const {
  const AxisState state = with_friction(x);
  constexpr auto FRICTION = static_cast<int>(AxisSlot::FRICTION_FORCE);
  constexpr auto VELOCITY = static_cast<int>(AxisSlot::VELOCITY);
  const double share = std::tanh(state[VELOCITY] / SMOOTHING_SPEED);
  AxisMatrix follow =
      AxisMatrix::Identity();  // of the state with friction by the state: friction follows the velocity
  follow(FRICTION, FRICTION) = 0.0;
  follow(FRICTION, VELOCITY) = -model_.friction_n * (1.0 - share * share) / SMOOTHING_SPEED;
  Jacobian result = Jacobian::Zero();
  result.topLeftCorner<AXIS_STATE_SIZE, AXIS_STATE_SIZE>() = model_.slipping * follow;
  for (std::size_t i = 0; i < ENERGY_FLOW_COUNT; ++i)
    result.row(AXIS_STATE_SIZE + static_cast<int>(i)).head<AXIS_STATE_SIZE>() =
        2.0 * (model_.power[i] * state).transpose() * follow;
  return result;
}

void SmoothedAxis::load(const AxisState& state, Vector& x) {
  x.head<AXIS_STATE_SIZE>() = state;
  x.tail<ENERGY_FLOW_COUNT>().setZero();
}

void SmoothedAxis::store(const Vector& x, AxisState& state, EnergyFlows& flows) {
  state = x.head<AXIS_STATE_SIZE>();
  flows += x.tail<ENERGY_FLOW_COUNT>();
}

}  // namespace lmdbench
