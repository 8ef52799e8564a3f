// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/number_text.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace lmdbench {
namespace {

constexpr int DIGITS = 3;
/// From where on three digits need an exponent, and so many digits that whole numbers are none.
constexpr double FIRST_WITH_EXPONENT = 999.5, FIRST_NOT_WHOLE = 1e9;

}  // namespace

std::string number_text(double value) {
  if (std::isnan(value)) return "-";
  const double size = std::abs(value);
  return size >= FIRST_WITH_EXPONENT && size < FIRST_NOT_WHOLE ? fmt::format("{:.0f}", value)
                                                               : fmt::format("{:.{}g}", value, DIGITS);
}

std::string share_text(double share, double whole) {
  if (!(share < 1.0)) return number_text(share * whole);
  std::string text;
  for (int digits = DIGITS; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    text = fmt::format("{:.{}g}", share * whole, digits);
    if (std::stod(text) < whole) break;
  }
  return text;
}

}  // namespace lmdbench
