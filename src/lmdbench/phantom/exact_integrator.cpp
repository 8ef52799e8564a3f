// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/phantom/exact_integrator.h>

#include <Eigen/Eigenvalues>
#include <boost/math/tools/toms748_solve.hpp>
#include <unsupported/Eigen/MatrixFunctions>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lmdbench {
namespace {

/// Largest norm of A t for which the integrals' series is summed: it ends after a dozen terms.
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
  LMDBENCH_EXPECTS(std::isfinite(t) && t >= 0.0, "a rate in place of a period");
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): a copy where Scalar is double
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

namespace {

constexpr double LOOKS = 8.0;           ///< A period, at least.
constexpr double LOOKS_A_RADIAN = 4.0;  ///< Of the fastest mode.

/// A device with more events in one servo period shivers about zero within rounding: it is stuck.
constexpr int MOST_EVENTS = 64;

}  // namespace

ExactIntegrator::ExactIntegrator(const AxisModel& model, double period)
    : model_(model),
      period_(period),
      slipping_(make_regime(model.slipping)),
      stuck_(make_regime(model.stuck)) {
  LMDBENCH_EXPECTS(period > 0.0, "a rate in place of a period, or no rate");
}

ExactIntegrator::Regime ExactIntegrator::make_regime(const AxisMatrix& matrix) const {
  const double fastest =
      Eigen::EigenSolver<AxisMatrix>(matrix, false).eigenvalues().imag().cwiseAbs().maxCoeff();
  const double look = period_ / std::max(LOOKS, std::ceil(LOOKS_A_RADIAN * fastest * period_));
  return {matrix, lasting_axis_flow(matrix, model_.power, period_), look, axis_transition(matrix, look)};
}

double ExactIntegrator::margin(const AxisState& state, bool stuck) const {
  if (stuck) return model_.friction_n - std::abs(model_.standing_force.dot(state));
  // Friction opposes the motion, so the product is positive until the velocity changes its sign.
  return -at(state, AxisSlot::VELOCITY) * at(state, AxisSlot::FRICTION_FORCE);
}

std::optional<double> ExactIntegrator::event_time(const Regime& regime, const AxisState& state, bool stuck,
                                                  double duration) const {
  double before = 0.0;
  double margin_before = margin(state, stuck);
  AxisState there = state;
  while (before < duration) {
    const bool last = before + regime.look >= duration;
    const double after = last ? duration : before + regime.look;
    there = last ? AxisState(axis_transition(regime.matrix, after - before) * there)
                 : AxisState(regime.one_look * there);
    const double margin_after = margin(there, stuck);
    if (margin_after < 0.0) {
      // A device that has just turned back starts with velocity 0: it has turned again at once.
      if (!(margin_before > 0.0)) return before;
      const auto function = [&](double t) {
        return margin(axis_transition(regime.matrix, t) * state, stuck);
      };
      std::uintmax_t iterations = 64;
      const auto [low, high] = boost::math::tools::toms748_solve(
          function, before, after, margin_before, margin_after,
          boost::math::tools::eps_tolerance<double>(std::numeric_limits<double>::digits), iterations);
      return high;
    }
    before = after;
    margin_before = margin_after;
  }
  return std::nullopt;
}

bool ExactIntegrator::settle_friction(AxisState& state) const {
  const double velocity = at(state, AxisSlot::VELOCITY);
  const double force = model_.standing_force.dot(state);
  double& friction = at(state, AxisSlot::FRICTION_FORCE);
  const bool stuck = velocity == 0.0 && std::abs(force) < model_.friction_n;
  // While stuck, friction balances whatever acts; it does no work, so its value does not matter.
  friction = stuck ? 0.0 : -std::copysign(model_.friction_n, velocity != 0.0 ? velocity : force);
  return stuck;
}

void ExactIntegrator::advance(AxisState& state, EnergyFlows& flows) {
  LMDBENCH_EXPECTS(state.allFinite(), "a force that is not a number");
  if (model_.friction_n == 0.0) {
    flows += slipping_.period.flows(state);
    state = slipping_.period.transition * state;
    return;
  }
  double remaining = period_;
  for (int events = 0; remaining > 0.0; ++events) {
    const bool stuck = settle_friction(state) || events >= MOST_EVENTS;
    if (events >= MOST_EVENTS) at(state, AxisSlot::VELOCITY) = at(state, AxisSlot::FRICTION_FORCE) = 0.0;
    const Regime& regime = stuck ? stuck_ : slipping_;
    const std::optional<double> event =
        events >= MOST_EVENTS ? std::nullopt : event_time(regime, state, stuck, remaining);
    const double duration = event.value_or(remaining);
    const bool whole = duration == period_;
    const AxisFlow partial = whole ? AxisFlow{} : axis_flow(regime.matrix, model_.power, duration);
    const AxisFlow& flow = whole ? regime.period : partial;
    flows += flow.flows(state);
    state = flow.transition * state;
    if (event && !stuck) at(state, AxisSlot::VELOCITY) = 0.0;
    remaining -= duration;
    LMDBENCH_EXPECTS(duration >= 0.0, "an event before the instant that it was looked for from");
  }
}

}  // namespace lmdbench
