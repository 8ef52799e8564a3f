// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

namespace lmdbench::scaling {

/// Cuts every triangle into four at the middles of its sides, `levels` times. The surface stays where it is
/// (middles are rounded to double precision), so only the number of triangles grows, not the contact. Sides
/// that share both ends share their middle: closed stays closed.
TriangleMesh subdivided(TriangleMesh mesh, int levels);

}  // namespace lmdbench::scaling
