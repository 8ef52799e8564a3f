// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <support/random.h>

#include <string>

namespace lmdbench::completeness {

/// A mesh that no program for design would make, and what was done to it.
struct HostileMesh {
  TriangleMesh mesh;
  std::string history;
};

/// A small generated shape, a grid or a soup of triangles on a lattice, of about the size 1,
/// changed up to three times. Vertices: jittered, squashed to a plane, rounded, merged, split,
/// pulled away. Triangles: doubled, flipped, removed, halved alone, a third at an edge. Or a copy
/// is merged into it. Depends on the random numbers alone.
HostileMesh make_hostile_mesh(experiments::Random& random);

}  // namespace lmdbench::completeness
