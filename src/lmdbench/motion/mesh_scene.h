// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>
#include <lmdbench/motion/generate.h>

namespace lmdbench {

/// Scene of two meshes, each turning about or standing at the origin of its frame; the fixed one's frame is
/// the world. Distances are exact (`nearest_pair`); each search begins with the nearest triangles of the one
/// before it as a bound, which changes nothing but the time. The distance function holds that memory: copies
/// share it, so use a scene from one thread.
/// @param moving, fixed placed meshes (`scaled_to_diagonal`)
PathScene mesh_scene(TriangleMesh moving, TriangleMesh fixed);

}  // namespace lmdbench
