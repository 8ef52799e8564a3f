// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/triangle_mesh.h>

/// Meshes broken on purpose, for scenes that test the methods on them. Each function flaws the
/// triangles 0, every, 2 * every, ... and keeps the others; `every` is at least 1 (asserted).
namespace lmdbench {

/// The chosen triangles are missing: a hole each.
TriangleMesh with_holes(const TriangleMesh& mesh, int every);

/// The chosen triangles are there twice; the copies come after all others.
TriangleMesh with_duplicates(const TriangleMesh& mesh, int every);

/// The chosen triangles are turned over: their normals point inwards.
TriangleMesh with_flips(const TriangleMesh& mesh, int every);

/// The chosen triangles carry a fin: a further triangle on their first edge that rises out of the
/// surface by `height` mean sides of the triangle, so that three triangles meet there.
TriangleMesh with_fins(const TriangleMesh& mesh, int every, double height);

/// The chosen triangles come with three triangles without area, after all others: one with two
/// equal corner numbers, one with collinear corners (first edge and its middle, a new vertex), one
/// with three vertices at the same place.
TriangleMesh with_zero_areas(const TriangleMesh& mesh, int every);

}  // namespace lmdbench
