// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/adjacency.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <string>
#include <string_view>

/// The outer side of a mesh's triangles: as in the file, or found. It decides what an LMD is: a
/// solid that is inside out has none.
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

/// Result of `orient_outward`.
struct OrientationReport {
  OrientationChoice choice = OrientationChoice::KEEP;
  std::int64_t turned_triangles = 0;
  std::int64_t pieces = 0;  ///< Groups of triangles that are connected over manifold edges.
  std::int64_t pieces_undecided =
      0;  ///< Open ones of which no side is outside; left as most of their triangles lie.
  std::int64_t disagreements =
      0;  ///< Edges whose two triangles still disagree: a Moebius strip has one at least.
};

/// Turns triangles until every piece of the surface has one outer side, away from the solid.
///  1. Triangles that share an edge with one other are made to agree, in the way that turns fewer.
///  2. A closed piece is turned to enclose a positive volume; a negative one where an odd number of
///     other closed pieces enclose it, because a cavity's outer side is its inside. Pieces
///     may touch; solids that share a whole face are not told apart. One without volume
///     (ZERO_VOLUME), as a sheet with both sides, is left.
///  3. An open piece is turned where the cone from its centroid over it has a clearly negative
///     volume (OPEN_VOLUME). A smaller one, as of a sheet, decides nothing; the report counts it.
/// The order of triangles and their first corners stay.
OrientationReport orient_outward(TriangleMesh& mesh);

/// The same, where the mesh's adjacency is known.
OrientationReport orient_outward(TriangleMesh& mesh, const Adjacency& adjacency);

/// Volumes over the 3/2 power of the area up to this are rounding.
inline constexpr double ZERO_VOLUME = 1e-13;

/// Least volume over the 3/2 power of the area (a ball: 0.094) of an open piece with an outer side.
inline constexpr double OPEN_VOLUME = 0.005;

/// A clause for people.
std::string to_text(const OrientationReport& report);

}  // namespace lmdbench
