// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/axis_flow.h>

#include <unsupported/Eigen/MatrixFunctions>

#include <cmath>
#include <limits>

namespace lmdbench {
namespace {

/// Largest norm of A t for which the series of the integrals is summed: it then ends after a dozen terms.
constexpr double LARGEST_SERIES_NORM = 0.25;

template <typename Scalar>
using Square = Eigen::Matrix<Scalar, AXIS_STATE_SIZE, AXIS_STATE_SIZE>;

/// int_0^t e^(A's) Q e^(As) ds = sum over k of t^(k+1) / (k+1)! L^k(Q), L(X) = A'X + X A.
template <typename Scalar>
Square<Scalar> integral_series(const Square<Scalar>& matrix, const Square<Scalar>& form, Scalar t) {
  Square<Scalar> term = form * t;
  Square<Scalar> sum = term;
  for (int k = 2; term.cwiseAbs().maxCoeff() >
                  sum.cwiseAbs().maxCoeff() * std::numeric_limits<Scalar>::epsilon() / Scalar(16);
       ++k) {
    const Square<Scalar> half = term * matrix;
    term = (half + half.transpose()) * (t / Scalar(k));
    sum += term;
  }
  return sum;
}

template <typename Scalar>
AxisFlow flow_in(const AxisMatrix& matrix_in_double, const std::array<AxisMatrix, ENERGY_FLOW_COUNT>& power,
                 double t) {
  const Square<Scalar> matrix = matrix_in_double.cast<Scalar>();
  const double norm = (matrix_in_double * t).cwiseAbs().rowwise().sum().maxCoeff();
  const int doublings = norm > LARGEST_SERIES_NORM ? std::ilogb(norm / LARGEST_SERIES_NORM) + 1 : 0;
  const Scalar step = std::ldexp(Scalar(t), -doublings);
  const Square<Scalar> short_exponent = matrix * step;
  const Square<Scalar> exponent = matrix * Scalar(t);
  const Square<Scalar> short_transition = short_exponent.exp();

  AxisFlow flow;
  flow.transition = exponent.exp().eval().template cast<double>();
  for (std::size_t i = 0; i < ENERGY_FLOW_COUNT; ++i) {
    Square<Scalar> transition = short_transition;
    Square<Scalar> energy = integral_series<Scalar>(matrix, power[i].cast<Scalar>(), step);
    for (int k = 0; k < doublings; ++k) {
      energy += (transition.transpose() * energy * transition).eval();
      transition = (transition * transition).eval();
    }
    flow.energy[i] = (Scalar(0.5) * (energy + energy.transpose())).template cast<double>();
  }
  return flow;
}

}  // namespace

EnergyFlows AxisFlow::flows(const AxisState& state) const {
  EnergyFlows result;
  for (std::size_t i = 0; i < ENERGY_FLOW_COUNT; ++i)
    result[static_cast<int>(i)] = state.dot(energy[i] * state);
  return result;
}

AxisMatrix axis_transition(const AxisMatrix& matrix, double t) {
  const AxisMatrix exponent = matrix * t;
  return exponent.exp();
}

AxisFlow axis_flow(const AxisMatrix& matrix, const std::array<AxisMatrix, ENERGY_FLOW_COUNT>& power,
                   double t) {
  return flow_in<double>(matrix, power, t);
}

AxisFlow lasting_axis_flow(const AxisMatrix& matrix, const std::array<AxisMatrix, ENERGY_FLOW_COUNT>& power,
                           double t) {
  return flow_in<long double>(matrix, power, t);
}

}  // namespace lmdbench
