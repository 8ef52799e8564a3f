// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <span>
#include <string_view>

/// Machine parts as exact meshes: plates with holes and slots, rings, gears, threads, ribs, shafts, and what goes into
/// what. About a metre large, closed manifolds without T-junctions; the same bits on every processor. Coordinates are
/// dyadic fractions or multiples of the sines of shapes.h, so that faces square to the axes are flat to the bit.
namespace lmdbench::parts {

struct Part {
  const char* name;
  TriangleMesh mesh;
};

/// All of them, by name.
std::span<const Part> machine_parts();

/// @throws UsageError for an unknown name
const TriangleMesh& machine_part(std::string_view name);

/// A back 0.125 m wide with teeth 0.625 m long.
/// @param tooth  width of a tooth and of the gap beside it [m]
TriangleMesh make_comb(int teeth, double tooth);

/// `count` by `count` square tiles with an eight-sided hole each: 48 triangles a tile, and the rim.
/// @param side, hole  of a tile, radius of its hole [m]
TriangleMesh make_perforated_sheet(int count, double side, double hole, double thickness);

/// Play between a part and the one that it goes into [m].
inline constexpr double CLEARANCE = 1.0 / 128.0;

}  // namespace lmdbench::parts
