// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/phantom/hand.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

/// One axis of the device with the hand on it: linear differential equations, constant inputs.
///
/// Rigid hand (its mass and the device's are one, M = m + m_h; all of it 0 without a hand):
///   M v' = F + P + C - b v - k_h y - b_h (v - u)
/// Hand with a grip:
///   m v' = F + P + C - b v - k_g (y - y_h) - b_g (v - v_h)
///   m_h v_h' = -k_h y_h - b_h (v_h - u) + k_g (y - y_h) + b_g (v - v_h)
/// y and y_h are positions relative to the meant path, which moves with u between two servo ticks:
/// y' = v - u. This keeps the springs' energies free of cancellation far from the origin.
namespace lmdbench {

/// Properties of the device, the same along each axis.
struct DeviceDynamics {
  double mass_kg = 0.0;            ///< Apparent mass at the stylus.
  double damping_n_s_per_m = 0.0;  ///< Viscous, against the ground.
  double friction_n = 0.0;         ///< Coulomb friction along each axis.
  std::optional<Hand> hand;
};

/// Places of the state vector. The last four are inputs, constant until they are set anew.
enum class AxisSlot : std::uint8_t {
  POSITION,        ///< y: of the device, relative to the meant path [m].
  VELOCITY,        ///< v: of the device [m/s].
  HAND_POSITION,   ///< y_h: of the hand's mass, relative to the meant path [m]; with a grip only.
  HAND_VELOCITY,   ///< v_h [m/s]; with a grip only.
  RENDERED_FORCE,  ///< F [N].
  PUSH,            ///< P [N].
  FRICTION_FORCE,  ///< C [N], against the motion.
  PATH_VELOCITY    ///< u: of the meant path [m/s].
};
inline constexpr int AXIS_STATE_SIZE = 8;
using AxisState = Eigen::Matrix<double, AXIS_STATE_SIZE, 1>;
using AxisMatrix = Eigen::Matrix<double, AXIS_STATE_SIZE, AXIS_STATE_SIZE>;

inline double& at(AxisState& state, AxisSlot slot) {
  return state[static_cast<int>(slot)];
}
inline double at(const AxisState& state, AxisSlot slot) {
  return state[static_cast<int>(slot)];
}

/// Ways by which energy enters or leaves the axis.
enum class EnergyFlow : std::uint8_t {
  RENDERED,  ///< Work of the rendered force on the device.
  PUSH,      ///< Work of the constant push.
  HAND,      ///< Work of the person who moves the far end of the hand's spring and damper.
  DAMPED,    ///< Lost in the dampers of device, hand and grip.
  FRICTION   ///< Lost to Coulomb friction.
};
inline constexpr std::size_t ENERGY_FLOW_COUNT = 5;

/// Energies that flowed [J], by EnergyFlow; losses are positive.
using EnergyFlows = Eigen::Matrix<double, ENERGY_FLOW_COUNT, 1>;

inline double& at(EnergyFlows& flows, EnergyFlow flow) {
  return flows[static_cast<int>(flow)];
}
inline double at(const EnergyFlows& flows, EnergyFlow flow) {
  return flows[static_cast<int>(flow)];
}

/// Energy that the axis holds [J].
struct StoredEnergy {
  double kinetic = 0.0;
  double spring = 0.0;  ///< In the springs of hand and grip.
};

/// The axis' equations.
struct AxisModel {
  AxisMatrix slipping;  ///< s' = slipping s while the device moves (or has no friction).
  AxisMatrix stuck;     ///< s' = stuck s while Coulomb friction holds the device; v stays 0.
  /// Net force on a device that stands still, without friction: a linear function of the state [N].
  AxisState standing_force;
  /// Power of each flow [W] as a quadratic form of the state: s^T power s, symmetric.
  std::array<AxisMatrix, ENERGY_FLOW_COUNT> power;
  double friction_n = 0.0;

  /// Half of these quadratic forms is the stored energy.
  AxisMatrix kinetic;
  AxisMatrix spring;

  StoredEnergy stored(const AxisState& state) const {
    return {0.5 * state.dot(kinetic * state), 0.5 * state.dot(spring * state)};
  }
};

/// @throws UsageError naming a mass that is not positive, or a damping, friction or hand figure
///   that is negative or not finite
AxisModel make_axis_model(const DeviceDynamics& dynamics);

}  // namespace lmdbench
