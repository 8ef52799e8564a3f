// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/surface.h>

namespace lmdbench {

/// Number of fans round a vertex: groups of its triangles that hang together over edges at the
/// vertex. 1 on a manifold (a disk, or a half disk on the boundary), more where surfaces touch in the
/// vertex only, 0 without triangles.
int fan_count(const Surface& surface, std::int32_t vertex);

/// More than one fan, or a non-manifold edge at the vertex.
bool is_non_manifold_vertex(const Surface& surface, std::int32_t vertex);

}  // namespace lmdbench
