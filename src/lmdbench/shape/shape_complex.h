// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/mesh/csr_rows.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/mesh/surface_change.h>
#include <lmdbench/mesh/vertex_fan.h>
#include <lmdbench/shape/flat_regions.h>
#include <lmdbench/shape/region_shape.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// The features of a mesh's shape, whatever triangles its planes are cut into: *regions* (faces in
/// one plane), *chains* (straight edges between the same regions) and *corners* (vertices inside
/// neither). On a scan nearly all triangles are regions, edges chains, vertices corners.
///
/// A feature is named by its *lead*: a region's lowest face, a chain's first edge, the vertex.
///
/// *Wings* are vectors that span the surface round a feature: d is in the feature's polar cone when
/// no wing has a component along d (decision/DEFINITION.md). They are differences of vertices.
/// - Of a corner: to the other end of each chain there; in regions wider than 126 degrees at the
///   corner also inside, no two neighbours more than a right angle apart; along the sides of
///   triangles without area.
/// - Of a chain: square to it into each of its regions, as long as the region is deep.
class ShapeComplex {
 public:
  FlatRegions regions;
  RegionShapes shapes;
  /// Some region or chain has more than one face or edge.
  bool is_joined = false;

  static ShapeComplex of(const Surface& surface);

  /// Follows a surface with moved vertices; the result is that of `of`, up to numbers of regions.
  /// Where moved triangles are and stay regions by themselves, only planes change. Else it is made
  /// anew, also in the first step that moves anything, unless a step without motion came before.
  void follow(const Surface& surface, const SurfaceChange& change);
  /// How often `follow` made the shape anew, perhaps with other features.
  std::uint32_t times_made_anew() const { return times_made_anew_; }

  std::int32_t lead_of_region(std::int32_t region) const { return regions.region_triangles[region].front(); }
  std::int32_t lead_of_chain(std::int32_t chain) const { return regions.edges_of_straight[chain].front(); }
  /// Of a region, chain or corner: the face, edge or vertex of the mesh.
  FeatureId lead_of(const FeatureId& feature) const {
    if (feature.kind == FeatureKind::EDGE) return {feature.kind, lead_of_chain(feature.index)};
    if (feature.kind == FeatureKind::FACE) return {feature.kind, lead_of_region(feature.index)};
    return feature;
  }
  std::int32_t region_of(std::int32_t face) const {
    return regions.region_of_triangle[static_cast<std::size_t>(face)];
  }
  std::int32_t chain_of(std::int32_t edge) const {
    return regions.straight_of_edge[static_cast<std::size_t>(edge)];
  }
  const std::array<std::int32_t, 2>& ends_of_chain(std::int32_t chain) const {
    return regions.straight_edges[static_cast<std::size_t>(chain)].ends;
  }
  bool is_corner(std::int32_t vertex) const {
    return !regions.vertex_is_inside[static_cast<std::size_t>(vertex)];
  }
  /// Whether it is the lead of a feature of the shape; triangles without area count as features.
  bool is_lead(const FeatureId& feature) const;
  /// Whether it is the lead of several faces or edges.
  bool is_lead_of_several(const FeatureId& feature) const;
  /// Whether a chain is one edge between regions of one triangle each.
  bool is_plain_chain(const Surface& surface, std::int32_t chain) const;
  /// Whether the side of a triangle at a chain's lead runs from the chain's first end to the other:
  /// a triangle is to the left of its sides.
  bool runs_along(const Surface& surface, std::int32_t chain, std::int32_t triangle) const;
  /// The outer side at a corner or chain, a unit vector in the mesh's frame; zero without one. Of a
  /// chain it is the sum of its regions' normals, as triangles there may be needles turned over; of
  /// a corner the pseudo-normal.
  /// @param feature  a vertex, or an edge whose index counts chains
  Vec3 outer_side(const Surface& surface, const FeatureId& feature) const;
  /// Appends the vertices that bound a lead's feature: a region's corners, a chain's ends.
  void append_corners(const Surface& surface, const FeatureId& lead,
                      std::vector<std::int32_t>& corners) const;

  /// Calls visit(w) for every wing of a corner, in the mesh's frame [m], until it returns false.
  /// @return whether visit never returned false
  template <class Visit>
  bool for_each_corner_wing(const Surface& surface, std::int32_t vertex, Visit&& visit) const {
    const std::int32_t row = corner_row_.empty() ? -1 : corner_row_[static_cast<std::size_t>(vertex)];
    if (row >= 0) return visit_row(row, visit);
    const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(vertex)];
    return for_each_neighbour(surface, vertex, [&](std::int32_t neighbour) {
      return visit(Vec3(surface.mesh.vertices[static_cast<std::size_t>(neighbour)] - p));
    });
  }

  /// The same for a chain.
  template <class Visit>
  bool for_each_chain_wing(const Surface& surface, std::int32_t chain, Visit&& visit) const {
    const std::int32_t row = chain_row_.empty() ? -1 : chain_row_[static_cast<std::size_t>(chain)];
    if (row >= 0) return visit_row(row, visit);
    const std::int32_t edge = lead_of_chain(chain);
    const auto& ends = surface.adjacency.edges[static_cast<std::size_t>(edge)];
    const Vec3& p = surface.mesh.vertices[static_cast<std::size_t>(ends[0])];
    const Vec3 along = surface.mesh.vertices[static_cast<std::size_t>(ends[1])] - p;
    const double squared_length = along.squaredNorm();
    for (const std::int32_t triangle : surface.adjacency.edge_triangles[edge])
      for (const std::int32_t corner : surface.mesh.triangles[static_cast<std::size_t>(triangle)]) {
        if (corner == ends[0] || corner == ends[1]) continue;
        const Vec3 to_corner = surface.mesh.vertices[static_cast<std::size_t>(corner)] - p;
        if (!visit(Vec3(to_corner - to_corner.dot(along) / squared_length * along))) return false;
      }
    return true;
  }

  /// The same for either.
  /// @param feature  a vertex, or an edge whose index counts chains
  template <class Visit>
  bool for_each_wing(const Surface& surface, const FeatureId& feature, Visit&& visit) const {
    return feature.kind == FeatureKind::VERTEX ? for_each_corner_wing(surface, feature.index, visit)
                                               : for_each_chain_wing(surface, feature.index, visit);
  }

  /// Calls visit(face) once for every face of a region whose box (RegionShape::frame) is within
  /// `within` of a box, until it returns false. @pre the region has a shape
  /// @return whether visit never returned false
  template <class Visit>
  bool for_each_face_near(std::int32_t region, const Box2& box, double within, Visit&& visit) const {
    const auto faces = regions.region_triangles[region];
    return shapes.of_region(region)->triangle_grid.for_each_near(
        box, within, [&](std::int32_t k) { return visit(faces[static_cast<std::size_t>(k)]); });
  }
  /// The face of a region that names a point of its plane: the first in the mesh's order that holds
  /// the point (NAMING_TOLERANCE), or the first of the region where none does.
  std::int32_t face_at(const Surface& surface, std::int32_t region, const Vec3& p_S) const;

  /// Appends the carriers of a shape feature: the regions that hold it, by index, and triangles
  /// without area, which are in no region, as -1 - index.
  /// @param feature  index counts regions, chains or vertices
  void append_carriers(const Surface& surface, const FeatureId& feature,
                       std::vector<std::int32_t>& carriers) const;

  std::size_t bytes() const;

 private:
  template <class Visit>
  bool visit_row(std::int32_t row, Visit& visit) const {
    const auto begin = static_cast<std::size_t>(wing_starts_[static_cast<std::size_t>(row)]);
    const auto end = static_cast<std::size_t>(wing_starts_[static_cast<std::size_t>(row) + 1]);
    for (std::size_t i = begin; i < end; ++i)
      if (!visit(wings_[i])) return false;
    return true;
  }
  bool keeps_features(const Surface& surface, const SurfaceChange& change);
  void find_lone_triangles(const Surface& surface);
  double lone_tolerance() const;
  bool is_plain(const Surface& surface, std::int32_t vertex) const;
  void append_corner_wings(const Surface& surface, std::int32_t vertex);
  void append_chain_wings(const Surface& surface, std::int32_t chain);

  // Only of features on regions or chains of several faces or edges; the mesh gives the others.
  std::vector<std::int32_t> corner_row_;  ///< #V, or empty; -1: none kept.
  std::vector<std::int32_t> chain_row_;   ///< #chains, or empty; -1: none kept.
  std::vector<std::int32_t> wing_starts_{0};
  std::vector<Vec3> wings_;

  std::uint32_t times_made_anew_ = 0;
  // For meshes that deform. #T; a region by itself while it and its neighbours stay as they are,
  // ...
  std::vector<bool> is_lone_;
  double lone_up_to_ = 0.0;     ///< ... at any extent up to this [m].
  bool some_not_lone_ = false;  ///< Some triangle with area is no such region.
};

}  // namespace lmdbench
