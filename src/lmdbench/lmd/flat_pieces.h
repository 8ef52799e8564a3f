// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/convex_polygon.h>
#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/first_order.h>
#include <lmdbench/lmd/plateau.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/mesh/flat_regions.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lmdbench {

/// The planar tolerances of both meshes [m]: 0 for meshes that are taken at their word.
double parallel_tolerance(const Surface& moving, const Surface& fixed);

/// Features of rounded meshes at a larger angle (a sine) are never parallel: at that tilt no tolerance that
/// rounding leaves spans more than a speck.
inline constexpr double LARGEST_PARALLEL_TILT = 5e-5;
/// The same where no mesh was rounded: beyond it rounding explains no tilt.
inline constexpr double LARGEST_EXACT_TILT = 1e-8;

/// When flat features of two meshes are parallel: one rule for the truth and for `certified`.
struct ParallelRule {
  /// How much their distance may vary over the place where they face each other [m]: of either mesh the planar
  /// tolerance, or what flat regions are flat to (FLATNESS), whichever is larger. A mesh that was turned once has
  /// planes that are planar to rounding only, and a small triangle of such a plane says little of its direction: that
  /// of the whole region counts.
  double allowance;
  double largest_tilt;  ///< Sine; beyond it nothing is parallel.
  double least_width;   ///< Thinner places are none [m].
  double
      least_gap;  ///< Features that are nearer somewhere, or cross, have no direction [m]: rounding, not the tolerance.
  bool is_exact;  ///< No mesh has a planar tolerance.

  static ParallelRule of(const Surface& moving, const FlatRegions& moving_regions, const Surface& fixed,
                         const FlatRegions& fixed_regions);

  /// @param tilt sine of the angle between the planes or lines
  /// @param variation of their distance over the place where they face each other [m]
  bool is_parallel(double tilt, double variation) const {
    return tilt <= largest_tilt && (variation <= allowance || (is_exact && tilt <= PARALLEL_TILT));
  }
  /// Edges of exact meshes that cross at a tiny angle drift apart sideways long before their distance tells.
  /// @param u, v from end to end of the straight edges
  bool drifts_sideways(const Vec3& u, const Vec3& v) const;
  /// Whether a polygon is thinner than `least_width`.
  bool is_speck(const ConvexPolygon& polygon, double area) const;
};

/// Direction of a parallel contact of two planes, from the moving one to the fixed one: the middle of their
/// normals where both meshes were rounded or neither was, else the normal of the one that was not.
Vec3 contact_direction(const Vec3& normal_moving, const Vec3& normal_fixed, const Surface& moving,
                       const Surface& fixed);

/// Parallel contact (ours; the definition's "parallel faces give a polygon of minimisers" made to hold for
/// files and for meshes that were turned). Two planes that were rounded apart are tilted by 1e-8 or so, in double
/// precision by 1e-15: to the letter the contact of two faces is then one corner, the contact of the next pose
/// another one. So two flat features, each a flat region or a straight edge, are parallel when the distance
/// between their planes or lines varies by no more than the `ParallelRule` allows over the place where they face
/// each other, or when they are tilted by no more than PARALLEL_TILT; all of that place is then a set of minimisers, at the
/// distance of its centroid. The rule is the same seen from either mesh.
///
/// This class finds such places triangle by triangle, edge by edge: slow and simple, for the ground truth, and for
/// `certified` where it leaves a place to its triangles.
class FlatPieces {
 public:
  explicit FlatPieces(const Scene& scene);

  /// Forgets what was offered.
  void clear() { pieces_.clear(); }
  /// Looks at two triangles within the cutoff, and at those of their edges that they are the first on.
  void offer(const RigidTransform& X_WM, std::int32_t body, std::int32_t t_moving, std::int32_t t_fixed);
  /// Forgets the pieces of flat features of which not all was offered: whether those are parallel cannot be known here.
  /// @param is_whole of a region or straight edge of the moving mesh and one of the fixed mesh
  template <class IsWhole>
  void keep_whole(IsWhole&& is_whole) {
    std::erase_if(pieces_,
                  [&](const Piece& piece) { return !is_whole(piece.place.moving, piece.place.fixed); });
  }
  /// Appends the pieces of flat features that are parallel. Segments that triangle pairs gave there go: an edge over
  /// the line between two triangles of a region has one with the line, and would be counted twice.
  /// @param first of `minima` that may go
  void append_parallel(std::vector<LocalMinimum>& minima, std::size_t first = 0);

 private:
  /// Two flat features: region or straight edge, by dimension and index.
  struct Place {
    std::int32_t body;
    int dimension;
    FeatureId moving, fixed;  ///< `index` counts regions or straight edges.
    auto operator<=>(const Place&) const = default;
  };
  /// Of an edge over a region: the part from begin to end (0 and 1 at the edge's ends) is over one triangle.
  struct OverFace {
    double begin = 0.0, end = 0.0;
    Vec3 x0 = Vec3::Zero(), u = Vec3::Zero();  ///< First end of the edge, and from there to the other; world.
    Vec3 n = Vec3::Zero();                     ///< From the edge to the region.
    Plane plane;                               ///< Of the region, in the world.
  };
  struct Piece {
    Place place;
    double tilt;
    double least_distance, greatest_distance;
    LocalMinimum minimum;
    OverFace over;
  };
  struct Side;

  void offer_faces(const Side& moving, const Side& fixed, std::int32_t body);
  void offer_edge_face(const Side& of_edge, std::size_t side, const Side& of_face, std::int32_t body);
  void offer_edges(const Side& moving, std::size_t side_moving, const Side& fixed, std::size_t side_fixed,
                   std::int32_t body);
  void add(const Side& moving, const Side& fixed, std::int32_t body, const Piece& piece);
  Place place_of(const LocalMinimum& minimum) const;
  void append_over_face(std::span<Piece> pieces, std::vector<LocalMinimum>& minima) const;
  bool is_along_border(const Place& place, const OverFace& over, const Vec3& x) const;

  const Scene& scene_;
  const FlatRegions* moving_ = nullptr;
  std::vector<const FlatRegions*> fixed_;
  std::vector<ParallelRule> rules_;  ///< Of each fixed body.
  RigidTransform X_WM_;              ///< Of what was offered last.
  std::vector<Piece> pieces_;
};

}  // namespace lmdbench
