// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/phantom/axis_model.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace lmdbench {

/// Carries one axis from servo tick to servo tick; its inputs stand still meanwhile (zero-order hold).
class AxisIntegrator {
 public:
  virtual ~AxisIntegrator() = default;

  /// Advances the state by one servo period and adds the energies that flowed to `flows`.
  virtual void advance(AxisState& state, EnergyFlows& flows) = 0;
};

/// How the device's equations are integrated between two servo ticks.
enum class Integration : std::uint8_t {
  EXACT,           ///< Matrix exponential between events of friction. The default.
  RUNGE_KUTTA_4,   ///< Boost.odeint, explicit, fixed step: one step a servo period.
  DORMAND_PRINCE,  ///< Boost.odeint, explicit, adaptive step.
  ROSENBROCK       ///< Boost.odeint, implicit for stiff equations, adaptive step.
};

/// All names of integrations as experiments write them, in the order of the enumeration.
std::span<const std::string_view> integration_names();

/// @param period servo period [s]
std::unique_ptr<AxisIntegrator> make_axis_integrator(Integration integration, const AxisModel& model,
                                                     double period);

}  // namespace lmdbench
