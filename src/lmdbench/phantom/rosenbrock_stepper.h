// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace lmdbench {

/// Integrates dx/dt = f(x) over `duration` by Boost.odeint's Rosenbrock method of order 4 with adaptive
/// steps. Its vectors come from a part of Boost that C++20 no longer compiles, so this alone is compiled as
/// C++17 and its interface is plain.
/// @param rates    (x, f(x)): reads and writes `size` numbers
/// @param jacobian (x, df/dx): writes `size` * `size` numbers, row by row
/// @param x        `size` numbers, replaced
void rosenbrock_advance(const std::function<void(const double*, double*)>& rates,
                        const std::function<void(const double*, double*)>& jacobian, double* x, int size,
                        double duration, double tolerance);

}  // namespace lmdbench
