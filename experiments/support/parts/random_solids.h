// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <support/random.h>

/// Random solids: closed, connected manifolds of about a metre with dyadic coordinates, which
/// depend on the random numbers.
namespace lmdbench::parts {

/// Whether a mesh is a closed, connected manifold.
bool is_sound(const TriangleMesh& mesh);

/// Boxes added to and subtracted from each other on an uneven grid.
TriangleMesh random_polycube(experiments::Random& random);

/// Sectors of a star-shaped polygon with random layers, with or without bore, upright or leaning.
TriangleMesh random_star_prism(experiments::Random& random);

}  // namespace lmdbench::parts
