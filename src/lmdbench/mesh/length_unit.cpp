// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/mesh/length_unit.h>

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace lmdbench {

std::span<const LengthUnit> length_units() {
  static constexpr std::array<LengthUnit, 6> UNITS{
      {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}}};
  return UNITS;
}

double metres_of_unit(const std::string& text, const std::string& place) {
  for (const LengthUnit& unit : length_units())
    if (text == unit.name) return unit.metres;
  double metres = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), metres);
  if (problem == std::errc{} && end == text.data() + text.size() && std::isfinite(metres) && metres > 0.0)
    return metres;
  std::string names;
  for (const LengthUnit& unit : length_units()) names += fmt::format("{}, ", unit.name);
  throw UsageError("", place, fmt::format("'{}' is no unit of length", text),
                   fmt::format("give {}or the metres of one unit, such as 0.001", names));
}

std::pair<double, double> metres_of_units(const std::string& text, const std::string& place) {
  const std::size_t comma = text.find(',');
  const double first = metres_of_unit(text.substr(0, comma), place);
  return {first, comma == std::string::npos ? first : metres_of_unit(text.substr(comma + 1), place)};
}

std::optional<double> metres_of_format(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".gltf" || extension == ".glb" ? std::optional(1.0) : std::nullopt;
}

}  // namespace lmdbench
