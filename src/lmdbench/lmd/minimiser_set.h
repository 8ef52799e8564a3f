// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/lmd.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/mesh/feature_corners.h>

#include <cstdint>
#include <vector>

namespace lmdbench {

/// Where the distance is that of a local minimum, up to the tolerances of a plateau: the points of the triangles
/// round both features that lie in the planes of contact and face each other along its direction. Any two of its
/// points are joined within it, by way of the minimum's own point, so that two minima of one contact whose sets
/// touch are of one connected set, and minima whose sets are apart are not, whatever corners their triangles share.
class MinimiserSet {
 public:
  /// @param tolerance of rounded meshes (parallel_tolerance) [m]
  MinimiserSet(const Scene& scene, const RigidTransform& X_WM, const Lmd& lmd, double tolerance);

  /// Calls visit(corner of the moving mesh, corner of the fixed one) for all corners of the triangles that the set lies
  /// on, some more than once: sets that have no such pair in common do not touch.
  template <class Visit>
  void for_each_corner_pair(Visit visit) const {
    for (const Part& part : parts_)
      for (const std::int32_t m : part.on_moving.view())
        for (const std::int32_t f : part.on_fixed.view()) visit(m, f);
  }
  /// Whether they meet where their triangles do: cells of a mesh that share no corner are apart, even at one place.
  /// @pre the other set has the same plane of contact
  bool touches(const MinimiserSet& other) const;

 private:
  /// A point, a segment or a convex polygon, by its corners; world, in the plane of contact.
  struct Part {
    std::vector<Vec3> shape;
    FeatureCorners on_moving,
        on_fixed;  ///< Of the triangles that it lies on; of the own point, of its features.
  };
  std::vector<Part> parts_;
  Vec3 point_, direction_;
  double gap_;  ///< That rounding may leave between sets that touch [m].
};

}  // namespace lmdbench
