// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <string>
#include <string_view>

/// Which side of a mesh's triangles is outside: as the file says, or found. The outer side decides what an LMD is, so on a solid that
/// is inside out there is none.
namespace lmdbench {

enum class OrientationChoice : std::uint8_t {
  KEEP,    ///< As in the file.
  OUTWARD  ///< Turned by `orient_outward`.
};

/// "keep", "outward"
std::string_view to_string(OrientationChoice choice);

/// @throws UsageError naming `place`
OrientationChoice parse_orientation(const std::string& text, const std::string& file,
                                    const std::string& place);

/// What `orient_outward` did.
struct OrientationReport {
  OrientationChoice choice = OrientationChoice::KEEP;
  std::int64_t turned_triangles = 0;
  std::int64_t pieces = 0;  ///< Groups of triangles that hang together over manifold edges.
  std::int64_t pieces_undecided =
      0;  ///< Open ones of which no side is outside; left as most of their triangles lie.
  std::int64_t disagreements =
      0;  ///< Edges whose two triangles still disagree: a Moebius strip has one at least.
};

/// Turns triangles until every piece of the surface has one outer side, away from the solid.
///  1. Triangles that share an edge with one other are made to agree; of the two ways that leaves, the one that turns fewer is taken
///     first.
///  2. A closed piece is turned so that it encloses a positive volume, or a negative one where an odd number of other closed pieces
///     enclose it: a cavity's outer side is its inside.
///  3. An open piece is turned where the cone from its centroid over it has a clearly negative volume (OPEN_VOLUME); where it is
///     smaller, as of a sheet, nobody can tell, and the report counts it.
/// Triangles' order and first corners stay.
OrientationReport orient_outward(TriangleMesh& mesh);

/// Volume over the 3/2 power of the area (a ball has 0.094) from which on an open piece has an outer side.
inline constexpr double OPEN_VOLUME = 0.005;

/// A clause for people.
std::string to_text(const OrientationReport& report);

}  // namespace lmdbench
