// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

/// What one unit of a mesh file's coordinates is. Most mesh files do not say; this program counts in metres.
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

/// Metres of a unit of a format that has one by its standard: glTF 2.0 is in metres. Nothing for OFF, OBJ, PLY and STL, nor for names of the
/// manifest.
std::optional<double> metres_of_format(const std::filesystem::path& file);

/// Coordinates that span more than this are taken for millimetres where nobody says what they are: a part of ten metres does not
/// hang on a haptic device.
inline constexpr double LARGEST_PLAUSIBLE_DIAGONAL = 10.0;

}  // namespace lmdbench
