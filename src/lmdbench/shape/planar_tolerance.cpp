// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/geometry/tolerance.h>
#include <lmdbench/shape/planar_tolerance.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <system_error>

namespace lmdbench {

namespace {

double read_back(const char* begin, const char* end) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(begin, end, value);
  return value;
}

/// Digits with which files write floats, significant ones or decimals: `%f` has 6, a double 16.
constexpr int LEAST_DIGITS = 6, MOST_DIGITS = 16;
/// In diagonals. A mesh so far from its frame's origin that rounding is larger is taken as it is.
constexpr double LARGEST_TOLERANCE = 1e-4;

/// Whether a coordinate is what a file says of its single-precision number.
bool is_float_printed(double coordinate, std::chars_format format, int digits) {
  const auto rounded = static_cast<double>(static_cast<float>(coordinate));
  if (!std::isfinite(rounded)) return false;
  std::array<char, 64> text{};
  const auto [end, problem] = std::to_chars(text.data(), text.data() + text.size(), rounded, format, digits);
  return problem == std::errc() && read_back(text.data(), end) == coordinate;
}

}  // namespace

double PlanarTolerance::length(const TriangleMesh& mesh) const {
  switch (kind) {
    case Kind::AUTO:
      return single_precision_tolerance(mesh);
    case Kind::LENGTH:
      return value;
    case Kind::DIAGONAL:
      return value * bounding_box_diagonal(mesh);
  }
  return 0.0;
}

PlanarTolerance parse_planar_tolerance(const std::string& text, const std::string& file,
                                       const std::string& place) {
  if (text == "auto") return {};
  if (text == "off") return {PlanarTolerance::Kind::LENGTH, 0.0};
  std::string_view number = text;
  const bool is_share = number.ends_with('%');
  if (is_share) number.remove_suffix(1);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (problem != std::errc{} || end != number.data() + number.size() || !(value >= 0.0) ||
      !std::isfinite(value))
    throw UsageError(
        file, place, fmt::format("'{}' is no planar tolerance", text),
        "give auto, off, a length in metres such as 1e-6, or percent of the diagonal such as 0.0001%");
  if (is_share) return {PlanarTolerance::Kind::DIAGONAL, value / 100.0};
  return {PlanarTolerance::Kind::LENGTH, value};
}

std::string to_string(const PlanarTolerance& tolerance) {
  switch (tolerance.kind) {
    case PlanarTolerance::Kind::AUTO:
      break;
    case PlanarTolerance::Kind::LENGTH:
      return tolerance.value > 0.0 ? fmt::format("{:g} m", tolerance.value) : "off";
    case PlanarTolerance::Kind::DIAGONAL:
      return fmt::format("{:g} % of the diagonal", 100.0 * tolerance.value);
  }
  return "auto";
}

bool is_single_precision(double coordinate) {
  const auto rounded = static_cast<float>(coordinate);
  if (static_cast<double>(rounded) == coordinate) return true;
  if (!std::isfinite(rounded)) return false;
  std::array<char, 64> text{};
  const auto shortest = std::to_chars(text.data(), text.data() + text.size(), rounded);
  return read_back(text.data(), shortest.ptr) == coordinate ||
         is_float_printed(coordinate, std::chars_format::general, 9);
}

bool is_single_precision(const TriangleMesh& mesh) {
  const auto all = [&](const auto& holds) {
    return std::ranges::all_of(mesh.vertices,
                               [&](const Vec3& p) { return holds(p.x()) && holds(p.y()) && holds(p.z()); });
  };
  const auto are_printed = [&](std::chars_format format, int digits) {
    return all([&](double coordinate) { return is_float_printed(coordinate, format, digits); });
  };
  if (all([](double coordinate) { return is_single_precision(coordinate); })) return true;
  for (int digits = LEAST_DIGITS; digits <= MOST_DIGITS; ++digits)
    if (are_printed(std::chars_format::general, digits) || are_printed(std::chars_format::fixed, digits))
      return true;
  return false;
}

double single_precision_tolerance(const TriangleMesh& mesh) {
  const double largest = largest_coordinate(mesh.vertices);
  if (!(largest > 0.0) || !is_single_precision(mesh)) return 0.0;
  const double ulp =
      std::exp2(std::floor(std::log2(largest))) * static_cast<double>(std::numeric_limits<float>::epsilon());
  const double tolerance = SINGLE_PRECISION_ULPS * ulp;
  return tolerance <= LARGEST_TOLERANCE * bounding_box_diagonal(mesh) ? tolerance : 0.0;
}

}  // namespace lmdbench
