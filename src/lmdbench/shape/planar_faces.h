// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/surface_change.h>
#include <lmdbench/shape/plane_fit.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

/// Triangles in one plane, connected over edges.
struct PlanarFace {
  Plane plane;
  std::vector<std::int32_t> triangles;  ///< Ascending.
  std::vector<std::int32_t> vertices;   ///< All of theirs, ascending.
};

/// A triangle whose least altitude is under this many tolerances may face any way: noise.
inline constexpr double LEAST_ORIENTED_ALTITUDE = 4.0;

/// Divides a mesh into its planar faces: every triangle with area is in one, most alone. A face's
/// vertices are within `tolerance` [m] of its plane; its triangles have the same outer side.
///
/// Faces grow from the largest triangles, whose planes are known best. One triangle's plane says
/// little about a point ten of its sizes away, so a face grows twice. First with the tolerance
/// widened by the error of the plane through the points so far at the next one, the plane fitted
/// anew whenever their number has doubled. Then once more from the same triangle, against the plane
/// of all points that the first growth reached, with the tolerance alone. A triangle lower than a
/// few tolerances starts no face: its plane is noise. No face crosses an edge with more or fewer
/// than two triangles, or two that disagree on orientation. Depends on the mesh alone: seeds are
/// taken by area, then index.
/// @param looked_at if given, gets a flag a triangle: whether it decided a possible face of several
std::vector<PlanarFace> planar_faces(const Surface& surface, double tolerance,
                                     std::vector<bool>* looked_at = nullptr);

/// Whether a face that starts with a triangle could take in the next one over an edge, or the
/// reverse, within a tolerance; else it is a face by itself. Never over edges that faces do not
/// cross. True if it is lower than LEAST_SEED_ALTITUDE tolerances or has no area.
/// @param asked  if given, triangles with a call of their own: faces starting with them are skipped
bool may_join_neighbour(const Surface& surface, std::int32_t triangle, double tolerance,
                        const SurfaceChange* asked = nullptr);

}  // namespace lmdbench
