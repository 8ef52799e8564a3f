// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/axis_integrator.h>
#include <lmdbench/phantom/exact_integrator.h>
#include <lmdbench/phantom/odeint_integrators.h>

#include <array>
#include <stdexcept>

namespace lmdbench {

std::span<const std::string_view> integration_names() {
  static constexpr std::array<std::string_view, 4> NAMES{"exact", "runge-kutta-4", "dormand-prince",
                                                         "rosenbrock"};
  return NAMES;
}

std::unique_ptr<AxisIntegrator> make_axis_integrator(Integration integration, const AxisModel& model,
                                                     double period) {
  switch (integration) {
    case Integration::EXACT:
      return std::make_unique<ExactIntegrator>(model, period);
    case Integration::RUNGE_KUTTA_4:
      return make_runge_kutta_4(model, period);
    case Integration::DORMAND_PRINCE:
      return make_dormand_prince(model, period);
    case Integration::ROSENBROCK:
      return make_rosenbrock(model, period);
  }
  throw std::invalid_argument("no such integration");
}

}  // namespace lmdbench
