// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/adjacency.h>
#include <lmdbench/mesh/feature.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// A mesh with all that is derived from it once and read by every method: immutable, shared between methods
/// and threads. Directions are unit vectors in the mesh's frame.
struct Surface {
  TriangleMesh mesh;
  Adjacency adjacency;
  std::vector<Vec3> face_normals;  ///< #T by 3; zero for a triangle without area.
  std::vector<Vec3>
      edge_pseudo_normals;  ///< #E by 3; normalised sum of the incident faces' normals, or zero.
  std::vector<Vec3> vertex_pseudo_normals;  ///< #V by 3; angle-weighted (Baerentzen and Aanaes 2005).
  std::vector<bool> edge_is_boundary;       ///< #E; the edge has exactly one triangle.
  std::vector<bool> vertex_is_boundary;     ///< #V; some incident edge is a boundary edge.
  std::vector<bool>
      edge_is_non_manifold;  ///< #E; more than two triangles, or two that disagree on orientation.

  /// Id of a triangle's part.
  FeatureId feature_of(std::int32_t triangle, TriangleFeature part) const;
  /// Triangles that contain the feature: one for a face, those on the edge, those round the vertex (paper,
  /// Fig. 5).
  std::span<const std::int32_t> incident_triangles(const FeatureId& feature) const;
  /// Pseudo-normal of the feature: decides the outer side.
  const Vec3& pseudo_normal(const FeatureId& feature) const;
  /// A boundary edge, or a vertex on one; a face never is.
  bool is_boundary(const FeatureId& feature) const;

 private:
  friend Surface build_surface(TriangleMesh mesh);
  std::vector<std::int32_t> face_rows_;  ///< 0 .. #T-1, so that a face's incident triangles are a span too.
};

/// Derives adjacency and normals. Triangles without area add nothing to any normal.
/// @pre every index is within the vertex array and every coordinate is finite (import checks both)
Surface build_surface(TriangleMesh mesh);

}  // namespace lmdbench
