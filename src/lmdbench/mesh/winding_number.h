// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <span>

namespace lmdbench {

/// Number of turns of a closed surface around a point: the sum of its triangles' signed solid
/// angles (Van Oosterom and Strackee 1983) over 4 pi; 0 outside, 1 inside, -1 if it is inside out.
double winding_number(const Vec3& point, const TriangleMesh& mesh);

/// The same for some of the mesh's triangles.
double winding_number(const Vec3& point, const TriangleMesh& mesh, std::span<const std::int32_t> triangles);

}  // namespace lmdbench
