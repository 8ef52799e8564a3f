// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/motion/generate.h>

namespace lmdbench {

/// Scene of two meshes, each turning about or standing at its frame's origin; the fixed one's frame
/// is the world. Distances are exact (`nearest_pair`); the nearest triangles of the last search
/// bound the next, for speed alone. Copies of the distance function share that memory: use a scene
/// from one thread.
/// @param moving, fixed placed meshes (`scaled_to_diagonal`)
PathScene mesh_scene(TriangleMesh moving, TriangleMesh fixed);

}  // namespace lmdbench
