// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/contract.h>
#include <lmdbench/methods/certified/layout/single_precision.h>

#include <cmath>
#include <limits>

namespace lmdbench {

float to_single(double value) {
  return static_cast<float>(value);
}

float round_up_to_single(double value) {
  LMDBENCH_EXPECTS(!std::isnan(value), "a bound that is not a number would reject everything");
  const float rounded = to_single(value);
  return static_cast<double>(rounded) < value
             ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
             : rounded;
}

}  // namespace lmdbench
