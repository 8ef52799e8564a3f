// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/phantom/rosenbrock_stepper.h>

#include <boost/numeric/odeint.hpp>
#include <boost/numeric/ublas/matrix.hpp>
#include <boost/numeric/ublas/vector.hpp>

#include <algorithm>
#include <utility>

namespace lmdbench {

void rosenbrock_advance(const std::function<void(const double*, double*)>& rates,
                        const std::function<void(const double*, double*)>& jacobian, double* x, int size,
                        double duration, double tolerance) {
  namespace odeint = boost::numeric::odeint;
  using Vector = boost::numeric::ublas::vector<double>;
  using Matrix = boost::numeric::ublas::matrix<double>;
  const auto system = [&](const Vector& at_x, Vector& dxdt, double) { rates(&at_x[0], &dxdt[0]); };
  const auto derivatives = [&](const Vector& at_x, Matrix& matrix, double, Vector& time_derivative) {
    jacobian(&at_x[0], &matrix(0, 0));
    std::fill(time_derivative.begin(), time_derivative.end(), 0.0);
  };
  Vector state(static_cast<std::size_t>(size));
  std::copy(x, x + size, state.begin());
  odeint::integrate_adaptive(odeint::make_controlled<odeint::rosenbrock4<double>>(tolerance, tolerance),
                             std::make_pair(system, derivatives), state, 0.0, duration, duration);
  std::copy(state.begin(), state.end(), x);
}

}  // namespace lmdbench
