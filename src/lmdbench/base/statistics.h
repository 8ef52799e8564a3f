// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <charconv>
#include <random>
#include <vector>

namespace lmdbench {

/// The one definition of quantiles, of results, studies and benchmarks: `share` in [0, 1] of the
/// values lies at or below the result, linearly interpolated between neighbours (numpy's default).
/// NaN values are unset and do not count; NaN when none is set.
double quantile(std::vector<double> values, double share);

/// Share of the quantile that reports show as p99.
inline constexpr double P99 = 0.99;

/// quantile(values, 0.5)
double median(std::vector<double> values);

/// Mean of the values that are set; NaN when none is.
double mean(const std::vector<double>& values);

/// Largest of the values that are set; NaN when none is.
double maximum(const std::vector<double>& values);

/// Uniform in [0, 1), multiples of 2^-53 from the generator's upper 53 bits. The same with every
/// standard library; the standard's distributions are not specified to the bit.
inline double uniform_number(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11U) * 0x1p-53;
}

/// The nearest number that can be written in so many decimal digits, for short files and messages.
/// The value itself where there is none, next to the ends of the range.
/// @param digits 1 to 17
inline double to_significant_digits(double value, int digits) {
  std::array<char, 32> text{};
  const auto written =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits - 1);
  double result = value;
  std::from_chars(text.data(), written.ptr, result);
  return result;
}

}  // namespace lmdbench
