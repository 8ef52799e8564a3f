// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <support/random.h>

#include <span>
#include <string_view>

/// Random shapes that are no prisms: what a lathe turns, what is swept, slit, ground to an edge, scanned or put together of
/// several solids. About a metre large, most coordinates dyadic, each shape as the random numbers have it. Turned parts, slit
/// blocks, thin plates and stellated solids are closed manifolds of one component that do not meet themselves; of the others see
/// formed_shapes().
namespace lmdbench::parts {

struct FormedShape {
  const char* name;
  TriangleMesh (*make)(experiments::Random& random);
};

/// "turned part" with shoulders, cones, ribs and grooves, undercut ones too, with or without a bore; "coil": a polygon swept along
/// a helix, a flat spiral or both, whose turns may lie on each other to the bit, or in each other; "slit block": wedge-shaped slits
/// and ridges of 1e-9 to a quarter; "thin plate" of 1e-9 to a hundredth, with holes; "stellated solid"; "scan": an open sheet with
/// holes; "truss": bars that pass through each other in its nodes; "bricks" that lie on each other, each with its own faces.
std::span<const FormedShape> formed_shapes();

/// Two solids that fill each other: every face of the one lies on a face of the other.
struct Mates {
  TriangleMesh inner, outer;
};
/// A turned part without a bore, and a block with a bore of its shape.
Mates random_turned_mates(experiments::Random& random);
/// Steps, facets or waves over a grid, and what is cast on it; half of the casts are cut into other triangles, or coarser.
Mates random_relief_mates(experiments::Random& random);

}  // namespace lmdbench::parts
