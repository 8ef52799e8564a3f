// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/catalogue/line_reader.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <span>

namespace lmdbench {

/// Adds a polygon's triangles: the fan of the first corner from which all turn as the polygon does.
/// A triangle turned over by less than 1e-6 of the area is rounding.
/// @param polygon  vertices of the mesh, at least 3
/// @param lines    at the polygon's line, for messages
/// @throws InputError where every fan would fold, or above the limits of corners and triangles
void add_polygon(std::span<const std::int32_t> polygon, const LineReader& lines, TriangleMesh& mesh);

}  // namespace lmdbench
