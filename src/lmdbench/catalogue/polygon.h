// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace lmdbench {

/// Why a polygon was not cut.
struct PolygonFault {
  std::string problem, remedy;
};

/// Adds a polygon's triangles, which turn as it does: the fan of the first corner from which all
/// have an area and none is turned over, else ears, cut one by one, else a fan with triangles
/// turned over by less than 1e-6 of the area, which is rounding. Of a corner along a side no
/// triangle without area is made; one at the place of the corner before is left out.
/// @param polygon  vertices of the mesh, at least 3
/// @return what is wrong, with an unchanged mesh: sides that cross, or a limit of corners or
///   triangles
[[nodiscard]] std::optional<PolygonFault> add_polygon(std::span<const std::int32_t> polygon,
                                                      TriangleMesh& mesh);

}  // namespace lmdbench
