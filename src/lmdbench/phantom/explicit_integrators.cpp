// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/odeint_integrators.h>
#include <lmdbench/phantom/smoothed_axis.h>

#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <array>

namespace lmdbench {
namespace {

namespace odeint = boost::numeric::odeint;
using Vector = std::array<double, SmoothedAxis::SIZE>;
using Map = Eigen::Map<const SmoothedAxis::Vector>;
using RungeKuttaStepper = odeint::runge_kutta4<Vector>;
using DormandPrinceStepper = odeint::runge_kutta_dopri5<Vector>;

/// The axis as a system of Boost.odeint.
auto system_of(const SmoothedAxis& axis) {
  return [&axis](const Vector& x, Vector& rates, double) {
    Eigen::Map<SmoothedAxis::Vector> result(rates.data());
    result = axis.rates(Map(x.data()));
  };
}

/// Integrates by `integrate(x)` and books the energies.
template <typename Integrate>
void advance_by(const Integrate& integrate, AxisState& state, EnergyFlows& flows) {
  SmoothedAxis::Vector loaded;
  SmoothedAxis::load(state, loaded);
  Vector x{};
  std::copy(loaded.begin(), loaded.end(), x.begin());
  integrate(x);
  SmoothedAxis::store(Map(x.data()), state, flows);
}

class RungeKutta4 final : public AxisIntegrator {
 public:
  RungeKutta4(const AxisModel& model, double period) : axis_(model), period_(period) {}

  void advance(AxisState& state, EnergyFlows& flows) override {
    advance_by([this](Vector& x) { stepper_.do_step(system_of(axis_), x, 0.0, period_); }, state, flows);
  }

 private:
  SmoothedAxis axis_;
  double period_;
  RungeKuttaStepper stepper_;
};

class DormandPrince final : public AxisIntegrator {
 public:
  DormandPrince(const AxisModel& model, double period) : axis_(model), period_(period) {}

  void advance(AxisState& state, EnergyFlows& flows) override {
    advance_by(
        [this](Vector& x) {
          odeint::integrate_adaptive(
              odeint::make_controlled<DormandPrinceStepper>(ADAPTIVE_TOLERANCE, ADAPTIVE_TOLERANCE),
              system_of(axis_), x, 0.0, period_, period_);
        },
        state, flows);
  }

 private:
  SmoothedAxis axis_;
  double period_;
};

}  // namespace

std::unique_ptr<AxisIntegrator> make_runge_kutta_4(const AxisModel& model, double period) {
  return std::make_unique<RungeKutta4>(model, period);
}

std::unique_ptr<AxisIntegrator> make_dormand_prince(const AxisModel& model, double period) {
  return std::make_unique<DormandPrince>(model, period);
}

}  // namespace lmdbench
