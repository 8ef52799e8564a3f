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

/// A small generated shape, a grid or a soup of triangles on a lattice, of about the size 1, to which up to three of these were
/// done: vertices jittered, squashed into a plane, rounded to floats or to a lattice, brought together, taken apart or pulled
/// away; triangles there twice, turned over, left out, halved without their neighbour, or a third one at an edge; its own copy
/// merged into it. What it is depends on the random numbers alone.
HostileMesh make_hostile_mesh(experiments::Random& random);

}  // namespace lmdbench::completeness
