// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <support/random.h>

#include <span>

/// Random shapes that are no prisms: turned, swept, slit, ground, scanned or joined from solids.
/// They are about a metre large, with mostly dyadic coordinates, and depend on the random numbers.
/// Turned parts, slit blocks, thin plates and stellated solids are closed manifolds of one
/// component without self-contact; for the others see formed_shapes().
namespace lmdbench::parts {

struct FormedShape {
  const char* name;
  TriangleMesh (*make)(experiments::Random& random);
};

/// "turned part": shoulders, cones, ribs, (undercut) grooves, maybe a bore; "coil": polygon swept
/// along a helix, spiral or both, turns may touch to the bit or overlap; "slit block": wedge-shaped
/// slits and ridges of 1e-9 to 1/4; "thin plate" of 1e-9 to 1/100, with holes; "stellated solid";
/// "scan": open, with holes; "truss": bars through each other; "bricks": each has its own faces.
std::span<const FormedShape> formed_shapes();

/// Two solids that fit without gaps: every face of one lies on a face of the other.
struct Mates {
  TriangleMesh inner, outer;
};
/// A turned part without a bore, and a block with a bore of its shape.
Mates random_turned_mates(experiments::Random& random);
/// Steps, facets or waves over a grid, and a cast; half the casts are cut otherwise or coarser.
Mates random_relief_mates(experiments::Random& random);

}  // namespace lmdbench::parts
