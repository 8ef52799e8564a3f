// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/csr_rows.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/shape/plane_fit.h>

#include <array>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// Edges of a mesh that lie end to end on one line between the same two flat regions, or one edge that borders others.
struct StraightEdge {
  std::array<std::int32_t, 2> ends{-1, -1};  ///< Vertices, the smaller one first.
};

/// What a mesh looks like without its tessellation: its triangles, joined where they lie in one plane, and
/// its edges, joined where they lie on one line. Edges inside a region and vertices inside a region or a
/// straight edge are no features of the shape; the direction of an LMD at such a place is that of the region
/// or edge round it.
struct FlatRegions {
  std::vector<Plane> planes;                     ///< #R; of each region, in the mesh's frame.
  std::vector<std::int32_t> region_of_triangle;  ///< #T; -1 for a triangle without area.
  CsrRows region_triangles;                      ///< #R rows, ascending.
  std::vector<StraightEdge> straight_edges;      ///< #S
  std::vector<std::int32_t> straight_of_edge;    ///< #E; -1 for an edge inside a region.
  CsrRows edges_of_straight;                     ///< #S rows of edges, from the first end to the second.
  CsrRows
      straight_edges_of_region;  ///< #R rows: the border of each; of more than two where sheets meet in an edge.
  double extent = 0.0;           ///< Largest coordinate of the mesh.
  std::vector<bool> vertex_is_inside;  ///< #V; of a region or of a straight edge.
  /// #T; whether the triangle had a say in what a region of several triangles is. A move of the others makes and unmakes no
  /// region but theirs.
  std::vector<bool> decides_region;
  /// #T, or empty where there are none: triangles without area that lie in one point or along an edge of others, where nothing else
  /// hangs on them. They add nothing to the surface: what only they have is no feature.
  std::vector<bool> adds_nothing;

  std::int32_t region_count() const { return static_cast<std::int32_t>(planes.size()); }

  /// The edge of a straight edge that names what lies at a point of it: the first in the mesh's order that holds the point
  /// (NAMING_TOLERANCE), or the first of all where none does.
  std::int32_t edge_at(const Surface& surface, std::int32_t straight, const Vec3& p_S) const;

  /// Regions are flat and edges straight to FLATNESS of the largest coordinate.
  static FlatRegions of(const Surface& surface);
};

/// Rounding, relative to the largest coordinate, within which vertices lie in one plane or on one line: what
/// a few operations in double precision leave.
inline constexpr double FLATNESS = 64.0 * 2.220446049250313e-16;

/// Distance, relative to the largest coordinate, up to which a point beside a face counts as on it, so that
/// the rounding of a point does not change its name.
inline constexpr double NAMING_TOLERANCE = 1e-9;

}  // namespace lmdbench
