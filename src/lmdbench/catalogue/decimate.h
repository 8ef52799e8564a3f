// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <string>

namespace lmdbench {

struct Decimation {
  TriangleMesh mesh;
  double relative_error = 0.0;  ///< meshoptimizer's quadric error, relative to the mesh's extent.
};

/// Simplifies a mesh to about `target_triangles` by meshoptimizer's quadric edge collapse. The
/// vertices are a subset of the mesh's, bit for bit. meshoptimizer works in single precision and
/// promises no manifold, so the result is checked: closed, manifold, oriented meshes stay so, and
/// no degenerate or duplicate triangle is new. A target at or above the count returns the mesh.
/// @param name  of the mesh, for messages
/// @throws InputError when the result breaks one of these, or is more than 1 % off the target
Decimation decimate(const TriangleMesh& mesh, std::int32_t target_triangles, const std::string& name);

}  // namespace lmdbench
