// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

namespace lmdbench {

/// Uniform in [0, 1), multiples of 2^-53: the generator's upper 53 bits, as many as a double holds. The same number with every standard
/// library; the standard's distributions are not specified to the bit.
inline double uniform_number(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11U) * 0x1p-53;
}

}  // namespace lmdbench
