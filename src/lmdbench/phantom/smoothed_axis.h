// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/phantom/axis_model.h>

namespace lmdbench {

/// Right-hand side of an axis with smoothed friction (`odeint_integrators.h`), over the state followed by the
/// energies: what the steppers of Boost.odeint have in common.
class SmoothedAxis {
 public:
  static constexpr int SIZE = AXIS_STATE_SIZE + static_cast<int>(ENERGY_FLOW_COUNT);
  using Vector = Eigen::Matrix<double, SIZE, 1>;
  using Jacobian = Eigen::Matrix<double, SIZE, SIZE, Eigen::RowMajor>;

  explicit SmoothedAxis(const AxisModel& model) : model_(model) {}

  Vector rates(const Vector& x) const;       ///< dx/dt
  Jacobian jacobian(const Vector& x) const;  ///< d(dx/dt)/dx

  /// The state, with no energy flowed yet.
  static void load(const AxisState& state, Vector& x);
  /// The state back; the energies are added.
  static void store(const Vector& x, AxisState& state, EnergyFlows& flows);

 private:
  /// The state with the friction force that belongs to its velocity.
  AxisState with_friction(const Vector& x) const;

  AxisModel model_;
};

}  // namespace lmdbench
