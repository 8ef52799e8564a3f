// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

/// Meshes broken on purpose, for scenes that show what the methods make of them. Each function leaves the
/// triangles 0, every, 2 * every, ... flawed and all others as they are; `every` is at least 1 (asserted).
namespace lmdbench {

/// The chosen triangles are missing: a hole each.
TriangleMesh with_holes(const TriangleMesh& mesh, int every);

/// The chosen triangles lie there twice; the copies come after all others.
TriangleMesh with_duplicates(const TriangleMesh& mesh, int every);

/// The chosen triangles are turned over: their normals point inwards.
TriangleMesh with_flips(const TriangleMesh& mesh, int every);

/// The chosen triangles carry a fin: a further triangle on their first edge that stands out of the surface by
/// `height` mean sides of the triangle, so that three triangles meet there.
TriangleMesh with_fins(const TriangleMesh& mesh, int every, double height);

/// The chosen triangles come with three triangles without area, after all others: one with two equal corner
/// numbers, one with its three corners in a line (first edge and its middle, a new vertex) and one with three
/// vertices of the same place.
TriangleMesh with_zero_areas(const TriangleMesh& mesh, int every);

}  // namespace lmdbench
