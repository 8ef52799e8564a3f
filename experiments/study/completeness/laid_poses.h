// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <support/random.h>

namespace lmdbench::completeness {

/// A pose that lays a triangle of the moving mesh on one of the fixed mesh: corner on corner with
/// the axes on axes, edge on edge in one plane from either side, or edge on edge at any angle. A
/// third is moved along the edge, a third by less than a hundredth. Unrelated poses hardly ever lay
/// edge on edge, which is where rounding decides most.
/// @param moving, fixed  with triangles, about 1 m large
Pose laid_pose(const TriangleMesh& moving, const TriangleMesh& fixed, experiments::Random& random);

/// A pose that lays a mesh in its own place, or moved from one of its vertices to another and
/// turned about the line through both by as little as rounding.
Pose laid_on_itself(const TriangleMesh& mesh, experiments::Random& random);

}  // namespace lmdbench::completeness
