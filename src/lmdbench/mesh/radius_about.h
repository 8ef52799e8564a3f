// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

namespace lmdbench {

/// Largest distance of a vertex from a point; 0 for a mesh without vertices.
double radius_about(const TriangleMesh& mesh, const Vec3& centre);

}  // namespace lmdbench
