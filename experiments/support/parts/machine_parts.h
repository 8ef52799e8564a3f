// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <span>
#include <string_view>

/// Machine parts as exact meshes: plates, rings, gears, threads, ribs, shafts, and mates for them.
/// About a metre large, closed, manifold, without T-junctions, the same bits on all processors.
/// Dyadic coordinates or multiples of sines (shapes.h): faces square to an axis are exactly flat.
namespace lmdbench::parts {

struct Part {
  const char* name;
  TriangleMesh mesh;
};

/// All parts.
std::span<const Part> machine_parts();

/// @throws UsageError for an unknown name
const TriangleMesh& machine_part(std::string_view name);

/// A back 0.125 m wide with teeth 0.625 m long.
/// @param tooth  width of a tooth and of the gap beside it [m]
TriangleMesh make_comb(int teeth, double tooth);

/// `count` by `count` square tiles with an eight-sided hole each: 48 triangles a tile, and the rim.
/// @param side, hole  side of a tile, radius of its hole [m]
TriangleMesh make_perforated_sheet(int count, double side, double hole, double thickness);

/// Play between a part and its counterpart [m].
inline constexpr double CLEARANCE = 1.0 / 128.0;

}  // namespace lmdbench::parts
