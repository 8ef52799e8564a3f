// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/phantom/axis_integrator.h>

#include <memory>

/// The integrators of Boost.odeint that `exact` is compared with. They integrate the energies beside the
/// state. None of them knows events: Coulomb friction is smoothed to f_c tanh(v / SMOOTHING_SPEED), as is
/// customary, so a device that should stick creeps. Where friction is large the smoothed equation is stiff.
namespace lmdbench {

/// Speed below which the smoothed friction falls off [m/s]: a tenth of a millimetre a second, a tenth of what
/// a quantum of 0.01 mm a tick would be read as.
inline constexpr double SMOOTHING_SPEED = 1e-4;

/// Relative error that the adaptive integrators allow a step, and the same in the units of the state.
inline constexpr double ADAPTIVE_TOLERANCE = 1e-9;

std::unique_ptr<AxisIntegrator> make_runge_kutta_4(const AxisModel& model, double period);
std::unique_ptr<AxisIntegrator> make_dormand_prince(const AxisModel& model, double period);
std::unique_ptr<AxisIntegrator> make_rosenbrock(const AxisModel& model, double period);

}  // namespace lmdbench
