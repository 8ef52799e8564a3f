// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/types.h>
#include <lmdbench/mesh/adjacency.h>
#include <lmdbench/mesh/feature.h>
#include <lmdbench/mesh/triangle_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// Indices of some triangles of a mesh: those of a row that the mesh holds, or a single one.
class TriangleList {
 public:
  explicit TriangleList(std::span<const std::int32_t> row) : row_(row.data()), size_(row.size()) {}
  explicit TriangleList(std::int32_t triangle) : single_(triangle), size_(1) {}

  const std::int32_t* begin() const { return row_ != nullptr ? row_ : &single_; }
  const std::int32_t* end() const { return begin() + size_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool contains(std::int32_t triangle) const { return std::find(begin(), end(), triangle) != end(); }
  std::int32_t front() const { return *begin(); }
  std::int32_t operator[](std::size_t i) const { return begin()[i]; }

 private:
  const std::int32_t* row_ = nullptr;
  std::int32_t single_ = -1;
  std::size_t size_;
};

/// A mesh with all that every method derives from it: shared between methods and threads, immutable
/// except where a mesh deforms (surface_change.h). Directions are unit vectors in the mesh's frame.
struct Surface {
  TriangleMesh mesh;
  Adjacency adjacency;
  std::vector<Vec3> face_normals;           ///< #T by 3; zero for a triangle without area.
  std::vector<Vec3> vertex_pseudo_normals;  ///< #V by 3; angle-weighted (Baerentzen, Aanaes 2005).
  /// #V, or empty. A deformation changed the pseudo-normal; it is made on demand, which is rare.
  std::vector<bool> vertex_normal_is_stale;
  std::vector<bool> edge_is_boundary;    ///< #E; the edge has exactly one triangle.
  std::vector<bool> vertex_is_boundary;  ///< #V; some incident edge is a boundary edge.
  std::vector<bool>
      edge_is_non_manifold;  ///< #E; more than two triangles, or two that disagree on orientation.
  std::vector<bool> vertex_has_non_manifold_edge;  ///< #V; some incident edge is non-manifold.
  /// #V; its triangles are several fans (groups connected over edges there) that share only it.
  std::vector<bool> vertex_has_several_fans;

  /// Between the ends of an edge, in the mesh's frame.
  Segment edge(std::int32_t index) const {
    return mesh.segment(adjacency.edges[static_cast<std::size_t>(index)]);
  }
  /// Id of a triangle's feature.
  FeatureId feature_of(std::int32_t triangle, TriangleFeature part) const;
  /// Triangles of the feature: the face, those on the edge, those round the vertex (paper, Fig. 5).
  TriangleList incident_triangles(const FeatureId& feature) const;
  /// Whether a feature is the triangle's own: also of a collapsed one, which rows leave out.
  bool holds(std::int32_t triangle, const FeatureId& feature) const;
  /// Whether no triangle has an edge but collapsed ones.
  bool is_of_collapsed(std::int32_t edge) const;
  /// Pseudo-normal of the feature: decides the outer side. Of an edge it is the normalised sum of
  /// the incident faces' normals, or zero; made on demand, because few ask for it.
  Vec3 pseudo_normal(const FeatureId& feature) const;
  Vec3 vertex_normal(std::int32_t vertex) const;
  /// Whether the feature is not on a boundary, and its triangles are one consistently oriented fan
  /// (of an edge: two). Stored: all decisions ask.
  bool is_one_fan(const FeatureId& feature) const;
  /// Whether the feature has an outer side: one fan, its pseudo-normal not zero.
  bool has_outer_side(const FeatureId& feature) const;
  /// A boundary edge, or a vertex on one; a face never is.
  bool is_boundary(const FeatureId& feature) const;
  /// Memory of all of this; certified, improved and exhaustive read nothing else of a mesh but
  /// their own hierarchies.
  std::size_t bytes() const;
};

/// Derives adjacency and normals. Triangles without area add nothing to any normal.
/// @pre every index is within the vertex array and every coordinate is finite (import checks both)
Surface build_surface(TriangleMesh mesh);

/// The direction of a sum of unit normals; zero where they cancel, as what is left is rounding.
/// @param weight  sum of the weights of the unit vectors in the sum
Vec3 direction_of_sum(const Vec3& sum, double weight);

/// The angle-weighted pseudo-normal of a vertex, from the face normals and the vertices round it.
Vec3 vertex_pseudo_normal(const Surface& surface, std::int32_t vertex);

inline Vec3 Surface::vertex_normal(std::int32_t vertex) const {
  const auto v = static_cast<std::size_t>(vertex);
  return vertex_normal_is_stale.empty() || !vertex_normal_is_stale[v] ? vertex_pseudo_normals[v]
                                                                      : vertex_pseudo_normal(*this, vertex);
}

/// Vertices of a feature with its ends: one, two or three.
class FeatureCorners {
 public:
  FeatureCorners(const Surface& surface, const FeatureId& feature) {
    const auto index = static_cast<std::size_t>(feature.index);
    switch (feature.kind) {
      case FeatureKind::VERTEX:
        vertices_[count_++] = feature.index;
        break;
      case FeatureKind::EDGE:
        for (const std::int32_t vertex : surface.adjacency.edges[index]) vertices_[count_++] = vertex;
        break;
      case FeatureKind::FACE:
        for (const std::int32_t vertex : surface.mesh.triangles[index]) vertices_[count_++] = vertex;
        break;
    }
  }
  std::span<const std::int32_t> view() const { return {vertices_.data(), count_}; }

 private:
  std::array<std::int32_t, 3> vertices_{};
  std::size_t count_ = 0;
};

}  // namespace lmdbench
