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

/// Edges end to end on one line between the same two flat regions, or one edge between others.
struct StraightEdge {
  std::array<std::int32_t, 2> ends{-1, -1};  ///< Vertices, the smaller one first.
};

/// A mesh without its tessellation: its triangles, joined where they are in one plane, and its
/// edges, joined where they are on one line. Edges inside a region and vertices inside a region or
/// straight edge are no features of the shape; an LMD there has the direction of that region or
/// edge.
struct FlatRegions {
  std::vector<Plane> planes;                     ///< #R; of each region, in the mesh's frame.
  std::vector<std::int32_t> region_of_triangle;  ///< #T; -1 for a triangle without area.
  CsrRows region_triangles;                      ///< #R rows, ascending.
  std::vector<StraightEdge> straight_edges;      ///< #S
  std::vector<std::int32_t> straight_of_edge;    ///< #E; -1 for an edge inside a region.
  CsrRows edges_of_straight;                     ///< #S rows of edges, first end to second.
  CsrRows straight_edges_of_region;              ///< #R rows: borders; one may be in over two.
  double extent = 0.0;                           ///< Largest coordinate of the mesh.
  std::vector<bool> vertex_is_inside;            ///< #V; of a region or of a straight edge.
  /// #T; whether a region of several triangles depended on the triangle. A move of the others makes
  /// and unmakes no region but theirs.
  std::vector<bool> decides_region;
  /// #T, or empty without any: triangles without area in one point or along an edge of others, with
  /// nothing else on them. They add nothing to the surface, so what only they have is no feature.
  std::vector<bool> adds_nothing;

  std::int32_t region_count() const { return static_cast<std::int32_t>(planes.size()); }

  /// The edge of a straight edge that names a point on it: the first in the mesh's order that holds
  /// the point (NAMING_TOLERANCE), or the first of all where none does.
  std::int32_t edge_at(const Surface& surface, std::int32_t straight, const Vec3& p_S) const;

  /// Regions are flat and edges straight to FLATNESS of the largest coordinate.
  static FlatRegions of(const Surface& surface);
};

/// Rounding of a few operations in double precision, relative to the largest coordinate, within
/// which vertices are in one plane or on one line.
inline constexpr double FLATNESS = 64.0 * 2.220446049250313e-16;

/// Distance, relative to the largest coordinate, up to which a point beside a face counts as on it,
/// so that rounding does not change its name.
inline constexpr double NAMING_TOLERANCE = 1e-9;

}  // namespace lmdbench
