// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <string>

namespace lmdbench {

/// Distance by which vertices of one plane may have left it, as a user gives it.
struct PlanarTolerance {
  enum class Kind : std::uint8_t {
    AUTO,     ///< Of the coordinates' own precision: `single_precision_tolerance`.
    LENGTH,   ///< `value` in metres; 0: vertices stay where they are.
    DIAGONAL  ///< `value` times the bounding box's diagonal.
  };
  Kind kind = Kind::AUTO;
  double value = 0.0;

  /// Of a mesh, in its unit.
  double length(const TriangleMesh& mesh) const;
  bool operator==(const PlanarTolerance&) const = default;
};

/// "auto", "off" or "0", metres ("1e-6"), or a share of the diagonal in percent ("0.0001%").
/// @throws UsageError naming `place`
PlanarTolerance parse_planar_tolerance(const std::string& text, const std::string& file,
                                       const std::string& place);
std::string to_string(const PlanarTolerance& tolerance);

/// Distance of the vertices of one plane from it, in units in the last place of single precision at
/// the mesh's largest coordinate. Rounding three coordinates moves a vertex by at most 0.87; files
/// with vertices turned or scaled in single precision carry a few such steps.
inline constexpr double SINGLE_PRECISION_ULPS = 4.0;

/// Whether a coordinate is a single-precision number: exactly, or as the decimals that files write
/// for one (the shortest that read back to it, or nine significant digits).
bool is_single_precision(double coordinate);

/// Whether all coordinates are, or all are single-precision numbers written with as many digits, 6
/// to 16 significant ones or decimals.
bool is_single_precision(const TriangleMesh& mesh);

/// SINGLE_PRECISION_ULPS where every coordinate is a single-precision number, else 0: other doubles
/// are taken as exact. Also 0 where it is more than 1e-4 of the diagonal: whole numbers far from
/// the origin may be exact, and such rounding would hide what the mesh is.
double single_precision_tolerance(const TriangleMesh& mesh);

}  // namespace lmdbench
