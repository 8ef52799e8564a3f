// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/surface_change.h>
#include <lmdbench/shape/plane_fit.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

/// Triangles that hang together over edges and lie in one plane.
struct PlanarFace {
  Plane plane;
  std::vector<std::int32_t> triangles;  ///< Ascending.
  std::vector<std::int32_t> vertices;   ///< All of theirs, ascending.
};

/// Divides a mesh into its planar faces: every triangle with area is in one of them, most alone. The vertices
/// of a face are within `tolerance` [m] of its plane, and its triangles turn the same side out.
///
/// Faces grow from the largest triangles, whose planes are known best. The plane of one triangle says little
/// about a point ten of its sizes away, so a face grows twice: first with the tolerance widened by what the
/// plane through the points so far may be off where the next one lies, the plane fitted anew each time their
/// number has doubled; then once more from the same triangle, against the plane of all points that the first
/// growth reached and with the tolerance alone. A triangle lower than a few tolerances starts nothing: its
/// plane is noise. Edges with more or fewer than two triangles, or two that disagree on orientation, are not
/// crossed. Depends on the mesh alone: seeds are taken by area, then index.
/// @param looked_at  where given, receives a flag a triangle: whether a face of more than one triangle, or what might have become one,
///                   was decided by it
std::vector<PlanarFace> planar_faces(const Surface& surface, double tolerance,
                                     std::vector<bool>* looked_at = nullptr);

/// Whether a face that starts with a triangle could take in the next one over an edge, or the other way round, within a tolerance:
/// where no edge of a triangle lets either happen, the triangle is a face by itself. Never for edges that faces do not cross.
/// A triangle lower than LEAST_SEED_ALTITUDE tolerances, or without area, is said to join.
/// @param asked  where given, triangles that are asked themselves: what starts with them is left out
bool may_join_neighbour(const Surface& surface, std::int32_t triangle, double tolerance,
                        const SurfaceChange* asked = nullptr);

}  // namespace lmdbench
