// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/plateau.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/mesh/flat_regions.h>

#include <compare>
#include <cstdint>
#include <vector>

namespace lmdbench {

/// How much the distance over two flat features may vary before they count as tilted [m]: the planar
/// tolerances of both meshes, 0 for meshes that are taken at their word.
double parallel_tolerance(const Surface& moving, const Surface& fixed);

/// Features at a larger angle (a sine) are never parallel: at that tilt no tolerance that rounding leaves
/// spans more than a speck.
inline constexpr double LARGEST_PARALLEL_TILT = 5e-5;

/// Direction of a parallel contact of two planes, from the moving one to the fixed one: the middle of their
/// normals where both meshes were rounded or neither was, else the normal of the one that was not.
Vec3 contact_direction(const Vec3& normal_moving, const Vec3& normal_fixed, const Surface& moving,
                       const Surface& fixed);

/// Parallel contact of rounded meshes (ours; the definition's "parallel faces give a polygon of minimisers"
/// made to hold for files). Two planes that were rounded apart are tilted by 1e-8 or so: to the letter the
/// contact of two faces is then one corner, the contact of the next pose another one. So where the meshes
/// have a planar tolerance, two flat features, each a flat region or a straight edge, are parallel when the
/// distance between their planes or lines varies by no more than `parallel_tolerance` over the place where
/// they face each other; all of that place is then a set of minimisers, at the distance of its centroid.
/// The rule is the same seen from either mesh.
///
/// This class finds such places triangle by triangle, edge by edge: slow and simple, for the ground truth.
class FlatPieces {
 public:
  explicit FlatPieces(const Scene& scene);

  /// Forgets what was offered.
  void clear() { pieces_.clear(); }
  /// Looks at two triangles within the cutoff, and at those of their edges that they are the first on.
  void offer(const RigidTransform& X_WM, std::int32_t body, std::int32_t t_moving, std::int32_t t_fixed);
  /// Appends the pieces of flat features that are parallel.
  void append_parallel(std::vector<LocalMinimum>& minima);

 private:
  /// Two flat features: region or straight edge, by dimension and index.
  struct Place {
    std::int32_t body;
    int dimension;
    FeatureId moving, fixed;  ///< `index` counts regions or straight edges.
    auto operator<=>(const Place&) const = default;
  };
  struct Piece {
    Place place;
    double least_distance, greatest_distance;
    LocalMinimum minimum;
  };
  struct Side;

  void offer_faces(const Side& moving, const Side& fixed, std::int32_t body);
  void offer_edge_face(const Side& of_edge, std::size_t side, const Side& of_face, std::int32_t body);
  void offer_edges(const Side& moving, std::size_t side_moving, const Side& fixed, std::size_t side_fixed,
                   std::int32_t body);
  void add(const Side& moving, const Side& fixed, std::int32_t body, const Piece& piece);

  const Scene& scene_;
  const FlatRegions* moving_ = nullptr;
  std::vector<const FlatRegions*> fixed_;
  std::vector<Piece> pieces_;
};

}  // namespace lmdbench
