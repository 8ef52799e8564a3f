// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <support/random.h>

namespace lmdbench::parts {

/// The same shape in other triangles: some edges are halved, diagonals of flat quadrilaterals
/// turned, vertices and triangles reordered. Closed meshes stay closed, and exact if their
/// coordinates have bits to spare. Edges of one triangle stay.
/// @pre triangles that share an edge agree on its orientation, and are two at most
TriangleMesh recut(TriangleMesh mesh, experiments::Random& random);

/// Its last two steps alone: turned diagonals; vertices, triangles and corners in another order.
TriangleMesh other_diagonals(TriangleMesh mesh, experiments::Random& random);
TriangleMesh reordered(TriangleMesh mesh, experiments::Random& random);

}  // namespace lmdbench::parts
