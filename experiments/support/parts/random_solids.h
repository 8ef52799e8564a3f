// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <support/random.h>

/// Solids that nobody drew: closed, connected manifolds of about a metre with dyadic coordinates, each as the random
/// numbers have it.
namespace lmdbench::parts {

/// Whether a mesh is a closed, connected manifold.
bool is_sound(const TriangleMesh& mesh);

/// Boxes added to and taken from each other on an uneven grid.
TriangleMesh random_polycube(experiments::Random& random);

/// Sectors of a random star-shaped polygon, each with a random set of layers, with or without a bore; upright or leaning.
TriangleMesh random_star_prism(experiments::Random& random);

}  // namespace lmdbench::parts
