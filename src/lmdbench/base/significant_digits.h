// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <charconv>

namespace lmdbench {

/// The number nearest to a value that can be written in so many decimal digits, so that files and messages hold what one can
/// say. The value itself where there is none, next to the ends of the range.
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
