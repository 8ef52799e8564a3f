// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/odeint_integrators.h>
#include <lmdbench/phantom/rosenbrock_stepper.h>
#include <lmdbench/phantom/smoothed_axis.h>

namespace lmdbench {
namespace {

class Rosenbrock final : public AxisIntegrator {
 public:
  Rosenbrock(const AxisModel& model, double period) : axis_(model), period_(period) {}

  void advance(AxisState& state, EnergyFlows& flows) override {
    SmoothedAxis::Vector x;
    SmoothedAxis::load(state, x);
    using Map = Eigen::Map<const SmoothedAxis::Vector>;
    rosenbrock_advance(
        [this](const double* at_x, double* dxdt) {
          Eigen::Map<SmoothedAxis::Vector> rates(dxdt);
          rates = axis_.rates(Map(at_x));
        },
        [this](const double* at_x, double* rows) {
          Eigen::Map<SmoothedAxis::Jacobian> jacobian(rows);
          jacobian = axis_.jacobian(Map(at_x));
        },
        x.data(), SmoothedAxis::SIZE, period_, ADAPTIVE_TOLERANCE);
    SmoothedAxis::store(x, state, flows);
  }

 private:
  SmoothedAxis axis_;
  double period_;
};

}  // namespace

std::unique_ptr<AxisIntegrator> make_rosenbrock(const AxisModel& model, double period) {
  return std::make_unique<Rosenbrock>(model, period);
}

}  // namespace lmdbench
