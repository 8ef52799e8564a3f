// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

/// Unit of a mesh file's coordinates. Most files do not say; this program uses metres.
namespace lmdbench {

struct LengthUnit {
  std::string_view name;  ///< "mm"
  double metres = 1.0;
};

/// m, cm, mm, um, in, ft.
std::span<const LengthUnit> length_units();

/// Metres of a unit: one of those names, or a number of metres above 0 ("0.001").
/// @throws UsageError naming `place` and listing the names
double metres_of_unit(const std::string& text, const std::string& place);

/// Of the moving and the fixed mesh: one unit for both, or two with a comma between ("mm,m").
/// @throws UsageError as above
std::pair<double, double> metres_of_units(const std::string& text, const std::string& place);

/// Metres of the unit that a format's standard sets (glTF 2.0: metres). Nothing for OFF, OBJ, PLY
/// and STL, nor for names of the manifest.
std::optional<double> metres_of_format(const std::filesystem::path& file);

/// Coordinates with a larger span count as millimetres where nobody says their unit: nobody holds
/// ten metres on a haptic device.
inline constexpr double LARGEST_PLAUSIBLE_DIAGONAL = 10.0;

}  // namespace lmdbench
