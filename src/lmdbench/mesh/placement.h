// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/error.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <cmath>
#include <string>

namespace lmdbench {

/// Refuses a mesh whose coordinates' products overflow or vanish in double precision (`LARGEST_COORDINATE`,
/// `SMALLEST_DIAGONAL`). A mesh without any extent is left to `check_mesh` and to scaling.
/// @param name  of the mesh or file, for the message
/// @throws InputError
void refuse_extreme_size(const TriangleMesh& mesh, const std::string& name);

/// The mesh as experiments and paths place it ("diagonal_m"): moved until the centre of its
/// axis-aligned bounding box is the origin of its frame, then scaled about the origin until the
/// box's diagonal has the given length. Every reader of a path must place its meshes with this
/// function, or the path's poses do not fit.
/// @param diagonal metres, > 0
/// @throws InputError when the mesh has no extent (no vertices, or all of them in one place) or gets coordinates
///         that products of lengths do not bear (`refuse_extreme_size`)
inline TriangleMesh scaled_to_diagonal(TriangleMesh mesh, double diagonal) {
  const double own_diagonal = bounding_box_diagonal(mesh);
  if (!(own_diagonal > 0.0) || !std::isfinite(diagonal / own_diagonal))
    throw InputError("", "", "the mesh has no extent and cannot be scaled",
                     "give a mesh with at least one triangle of some size");
  const Vec3 centre = bounding_box_centre(mesh);
  const double factor = diagonal / own_diagonal;
  for (Vec3& vertex : mesh.vertices) vertex = factor * (vertex - centre);
  mesh.planar_tolerance *= factor;
  refuse_extreme_size(mesh, "");
  return mesh;
}

}  // namespace lmdbench
