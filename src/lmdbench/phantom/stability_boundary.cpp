// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/phantom/exact_integrator.h>
#include <lmdbench/phantom/stability_boundary.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace lmdbench {
namespace {

using Complex = std::complex<double>;

/// Points of the search on the unit circle from 0 to half a turn: even ones, and logarithmically
/// even ones from the slowest oscillation on.
constexpr int EVEN_LOOKS = 4096;
constexpr int LOOKS_A_DELAYED_FRAME = 64;  ///< Each delayed frame turns H by half a turn more.
constexpr int LOGARITHMIC_LOOKS = 4096;
constexpr double SLOWEST_ANGLE = 1e-8;  ///< [rad] a servo period: one oscillation in 10^9 frames.

/// Sampled axis: s_(n+1) = phi s_n + gamma F_n; the contact sees lever * s[0], pushes with F lever.
struct SampledAxis {
  Eigen::MatrixXd phi;
  Eigen::VectorXd gamma;
  double lever = 1.0;
};

SampledAxis sample(const DeviceDynamics& dynamics, double period, double lever) {
  const AxisMatrix transition = axis_transition(make_axis_model(dynamics).slipping, period);
  const bool grip = dynamics.hand && dynamics.hand->has_grip();
  const int size = grip ? 4 : 2;
  return {transition.topLeftCorner(size, size),
          transition.col(static_cast<int>(AxisSlot::RENDERED_FORCE)).head(size), lever};
}

/// One axis, or two with a turn.
std::vector<SampledAxis> sample(const SampledLoop& loop) {
  if (!(std::isfinite(loop.period_s) && loop.period_s > 0.0))
    throw UsageError("", "period_s", fmt::format("{} is not usable", loop.period_s), "give a period above 0");
  if (loop.delay_frames < 0)
    throw UsageError("", "delay_frames", fmt::format("{} is negative", loop.delay_frames), "give at least 0");
  std::vector<SampledAxis> axes{sample(loop.dynamics, loop.period_s, 1.0)};
  if (loop.turn) axes.push_back(sample(loop.turn->dynamics, loop.period_s, loop.turn->lever_m));
  return axes;
}

/// H(e^(i angle)): sensed position per rendered force, delay included.
Complex response(const std::vector<SampledAxis>& axes, std::int64_t delay, double angle) {
  const Complex z = std::polar(1.0, angle);
  Complex sum = 0.0;
  for (const SampledAxis& axis : axes) {
    Eigen::MatrixXcd matrix = -axis.phi.cast<Complex>();
    matrix.diagonal().array() += z;
    const Eigen::VectorXcd state = matrix.partialPivLu().solve(axis.gamma.cast<Complex>());
    sum += axis.lever * axis.lever * state[0];
  }
  return sum * std::polar(1.0, -angle * static_cast<double>(delay));
}

std::vector<double> looks(std::int64_t delay) {
  std::vector<double> angles;
  const double pi = std::numbers::pi;
  const std::int64_t even = EVEN_LOOKS + LOOKS_A_DELAYED_FRAME * delay;
  for (std::int64_t i = 1; i < even; ++i)
    angles.push_back(pi * static_cast<double>(i) / static_cast<double>(even));
  const double decades = std::log(pi / SLOWEST_ANGLE);
  for (int i = 0; i < LOGARITHMIC_LOOKS; ++i)
    angles.push_back(SLOWEST_ANGLE * std::exp(decades * i / LOGARITHMIC_LOOKS));
  std::sort(angles.begin(), angles.end());
  angles.push_back(pi);
  return angles;
}

double total_damping(const DeviceDynamics& dynamics) {
  double sum = dynamics.damping_n_s_per_m;
  if (dynamics.hand) sum += dynamics.hand->damping_n_s_per_m;
  if (dynamics.hand && dynamics.hand->has_grip()) sum += dynamics.hand->grip_damping_n_s_per_m;
  return sum;
}

}  // namespace

double critical_stiffness(const SampledLoop& loop) {
  const std::vector<SampledAxis> axes = sample(loop);
  if (total_damping(loop.dynamics) == 0.0) return 0.0;
  if (loop.turn && loop.turn->lever_m != 0.0 && total_damping(loop.turn->dynamics) == 0.0) return 0.0;
  double largest_inverse = 0.0;  // of 1 / K, so that no crossing is an infinite K
  const auto consider = [&](double angle) {
    largest_inverse = std::max(largest_inverse, -response(axes, loop.delay_frames, angle).real());
  };
  double before = 0.0;
  double imaginary_before = 0.0;
  for (const double angle : looks(loop.delay_frames)) {
    const double imaginary = response(axes, loop.delay_frames, angle).imag();
    if (imaginary_before * imaginary < 0.0) {
      std::uintmax_t iterations = 100;
      const auto [low, high] = boost::math::tools::toms748_solve(
          [&](double a) { return response(axes, loop.delay_frames, a).imag(); }, before, angle,
          imaginary_before, imaginary,
          boost::math::tools::eps_tolerance<double>(std::numeric_limits<double>::digits - 2), iterations);
      consider(0.5 * (low + high));
    }
    before = angle;
    imaginary_before = imaginary;
  }
  consider(std::numbers::pi);  // H is real there: a crossing of the real axis that changes no sign
  return 1.0 / largest_inverse;
}

double spectral_radius(const SampledLoop& loop, double stiffness) {
  const std::vector<SampledAxis> axes = sample(loop);
  Eigen::Index size = 0;
  for (const SampledAxis& axis : axes) size += axis.phi.rows();
  const Eigen::Index delay = loop.delay_frames;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size + delay, size + delay);
  Eigen::VectorXd touched = Eigen::VectorXd::Zero(size);  // depth of the contact, by state
  Eigen::VectorXd pushed = Eigen::VectorXd::Zero(size);   // effect of a force on the state
  Eigen::Index first = 0;
  for (const SampledAxis& axis : axes) {
    const Eigen::Index rows = axis.phi.rows();
    matrix.block(first, first, rows, rows) = axis.phi;
    touched[first] = axis.lever;
    pushed.segment(first, rows) = axis.lever * axis.gamma;
    first += rows;
  }
  if (delay == 0) {
    matrix.topLeftCorner(size, size) -= stiffness * pushed * touched.transpose();
  } else {
    matrix.col(size + delay - 1).head(size) = pushed;
    matrix.row(size).head(size) = -stiffness * touched.transpose();
    for (Eigen::Index i = 1; i < delay; ++i) matrix(size + i, size + i - 1) = 1.0;
  }
  return matrix.eigenvalues().cwiseAbs().maxCoeff();
}

double sufficient_stiffness(const SampledLoop& loop) {
  const auto at_device = [](const DeviceDynamics& dynamics) {
    const bool rigid_hand = dynamics.hand && !dynamics.hand->has_grip();
    return dynamics.damping_n_s_per_m + (rigid_hand ? dynamics.hand->damping_n_s_per_m : 0.0);
  };
  double damping = at_device(loop.dynamics);
  if (loop.turn && loop.turn->lever_m != 0.0 && damping > 0.0)
    damping =
        1.0 / (1.0 / damping + loop.turn->lever_m * loop.turn->lever_m / at_device(loop.turn->dynamics));
  return damping / (loop.period_s * (0.5 + static_cast<double>(loop.delay_frames)));
}

}  // namespace lmdbench
