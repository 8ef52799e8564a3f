// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

namespace lmdbench::scaling {

/// Cuts every triangle into four at the middles of its sides, `levels` times. The surface stays
/// (middles are rounded to double precision): the number of triangles grows, the contact does not.
/// Sides with the same ends share their middle, so that a closed mesh stays closed.
TriangleMesh subdivided(TriangleMesh mesh, int levels);

}  // namespace lmdbench::scaling
