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

namespace lmdbench {

namespace {

double read_back(const char* begin, const char* end) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(begin, end, value);
  return value;
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
  if (read_back(text.data(), shortest.ptr) == coordinate) return true;
  const auto nine = std::to_chars(text.data(), text.data() + text.size(), static_cast<double>(rounded),
                                  std::chars_format::general, 9);
  return read_back(text.data(), nine.ptr) == coordinate;
}

double single_precision_tolerance(const TriangleMesh& mesh) {
  const bool all = std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const Vec3& p) {
    return is_single_precision(p.x()) && is_single_precision(p.y()) && is_single_precision(p.z());
  });
  const double largest = largest_coordinate(mesh.vertices);
  if (!all || !(largest > 0.0)) return 0.0;
  const double ulp =
      std::exp2(std::floor(std::log2(largest))) * static_cast<double>(std::numeric_limits<float>::epsilon());
  return SINGLE_PRECISION_ULPS * ulp;
}

}  // namespace lmdbench
