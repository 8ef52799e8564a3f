// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/mesh/surface.h>
#include <lmdbench/shape/shape_complex.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// One of the two meshes at a pose.
struct ShapeSide {
  const Surface& surface;
  const ShapeComplex& shape;
  const RigidTransform& X_WS;
  bool is_moving;  ///< X_WS of the fixed mesh is the identity and is not applied.

  const Vec3& vertex_S(std::int32_t v) const { return surface.mesh.vertices[static_cast<std::size_t>(v)]; }
  Vec3 vertex(std::int32_t v) const { return is_moving ? X_WS.point(vertex_S(v)) : vertex_S(v); }
  /// In the world.
  Triangle triangle(std::int32_t t) const {
    const Triangle own = surface.mesh.triangle(t);
    return is_moving ? X_WS.triangle(own) : own;
  }
  Vec3 direction(const Vec3& d_S) const { return is_moving ? X_WS.direction(d_S) : d_S; }
  Vec3 direction_to_surface(const Vec3& d_W) const {
    return is_moving ? Vec3(X_WS.rotation.transpose() * d_W) : d_W;
  }
  Vec3 point_to_surface(const Vec3& p_W) const {
    return is_moving ? Vec3(X_WS.rotation.transpose() * (p_W - X_WS.translation)) : p_W;
  }
  /// Plane of a region in the world.
  Plane plane(std::int32_t region) const {
    const Plane& own = shape.regions.planes[static_cast<std::size_t>(region)];
    return is_moving ? Plane{X_WS.point(own.point), X_WS.direction(own.normal)} : own;
  }
  /// Motion of this mesh against the other for a displacement of the moving mesh by 1.
  double sign() const { return is_moving ? 1.0 : -1.0; }

  // Of leads. They are read in the mesh itself where they are in it: on a scan all are.

  /// The lead's feature of the shape; its index counts regions, chains or vertices, -1: of none.
  FeatureId feature_of_lead(const FeatureId& lead) const {
    if (lead.kind == FeatureKind::EDGE) return {lead.kind, shape.chain_of(lead.index)};
    if (lead.kind == FeatureKind::FACE) return {lead.kind, shape.region_of(lead.index)};
    // A vertex without triangles is no corner either.
    const bool is_one = shape.is_corner(lead.index) && !surface.incident_triangles(lead).empty();
    return {lead.kind, is_one ? lead.index : -1};
  }
  /// Ends of the chain of a lead.
  const std::array<std::int32_t, 2>& ends_of_lead(std::int32_t edge) const {
    return shape.is_joined ? shape.ends_of_chain(shape.chain_of(edge))
                           : surface.adjacency.edges[static_cast<std::size_t>(edge)];
  }
  /// Plane in the world of the region of a lead; its normal is zero where the face has no area.
  Plane plane_of_lead(std::int32_t face) const {
    const std::int32_t region = shape.is_joined ? shape.region_of(face) : -1;
    if (region >= 0) return plane(region);
    const auto t = static_cast<std::size_t>(face);
    return {vertex(surface.mesh.triangles[t][0]), direction(surface.face_normals[t])};
  }
  /// Shape of the region of a lead; null for a face alone.
  const RegionShape* shape_of_lead(std::int32_t face) const {
    const std::int32_t region = shape.is_joined ? shape.region_of(face) : -1;
    return region < 0 ? nullptr : shape.shapes.of_region(region);
  }
};

/// What two features of the shapes share: a point of each or, where they are parallel, a segment or
/// polygon of minimisers of the distance. World coordinates.
struct Contact {
  /// A larger error of the direction leaves it open between faces at an angle, and a distance up to
  /// this share of rounding says nothing. Farther apart, the faces' distances would be wrong by it.
  static constexpr double LARGEST_KNOWN_ERROR = 0.01, TOUCHING_SHARE = 0.125;

  FeatureId moving, fixed;  ///< `index` counts regions, chains or vertices.
  int dimension = 0;        ///< 0: a pair of points, 1: of segments, 2: of polygons.
  double distance = 0.0;    ///< Of the points [m].
  Vec3 point_moving, point_fixed;
  Vec3 direction;  ///< Unit vector, from the moving mesh to the fixed one.
  /// Sine of the direction's error: 0 for a plane's normal; between points rounding / distance;
  /// of parallel chains with their change of distance. No more than the cones of both leave open.
  double direction_error = 0.0;
  double fall = 0.0;       ///< Sine of a slope down that rounding may have hidden at this minimum.
  double least_gap = 0.0;  ///< Least distance over the contact, negative where it crosses [m].
  double change = 0.0;     ///< Of parallel chains, of the vector between them [m].
  double measure = 0.0;    ///< Length [m] or area [m^2].
  std::array<Vec3, 2> ends_moving, ends_fixed;     ///< Of segments.
  std::uint32_t first_piece = 0, piece_count = 0;  ///< Of polygons: in ContactSet::pieces.
  std::uint32_t frame = 0;                         ///< Of polygons: in ContactSet::frames.
  bool is_whole = false;  ///< Of polygons: all that the two regions share over each other.
  /// Of polygons: some contact that it covers was taken out (covered_contacts.h); a pair of points.
  bool covers = false, covers_point = false;
  bool is_minimum = true;  ///< False for a critical pair that adds only an index (critical_index.h)
  int index = 0;           ///< Of critical pairs, where they are asked for.
  bool is_basin = false;   ///< Nothing round either feature is nearer where the index was taken.

  /// Not where edges along each other or corners touch, nor beside edges that are not quite
  /// parallel.
  bool knows_direction(double rounding) const {
    return direction_error <= LARGEST_KNOWN_ERROR ||
           distance > std::max(TOUCHING_SHARE * rounding, change / LARGEST_KNOWN_ERROR);
  }
};

/// The contacts of two meshes at a pose.
struct ContactSet {
  std::vector<Contact> contacts;
  std::vector<ConvexPolygon> pieces;
  std::vector<PlanarFrame> frames;

  void clear() {
    contacts.clear();
    pieces.clear();
    frames.clear();
  }
  std::span<const ConvexPolygon> pieces_of(const Contact& contact) const {
    return std::span(pieces).subspan(contact.first_piece, contact.piece_count);
  }
};

}  // namespace lmdbench
