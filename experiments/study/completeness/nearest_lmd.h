// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/scene.h>

#include <optional>

namespace lmdbench::completeness {

/// The distance that the nearest LMD of a pose must have.
struct NearestLmd {
  double distance = 0.0;   ///< Of the nearest pair [m].
  double tolerance = 0.0;  ///< [m]
};

/// "The nearest pair of two closed meshes is an LMD unless one of them lies inside the other"
/// (DEFINITION.md). The hierarchies' nearest pair of triangles knows neither features nor cones.
class NearestLmds {
 public:
  /// @param scene     a pair
  /// @param by_design whether closed meshes bound solids: rounding alone folds their needles. Else
  ///                  they must not intersect themselves: folds have no outer side. Nor may
  ///                  triangles without area close T junctions, which loading flips.
  explicit NearestLmds(const Scene& scene, bool by_design = false);
  /// Nothing where the meshes are no solids, nearer than the tolerance or, less that, beyond the
  /// cutoff, or where the nearest pair lies inside one or no solid is behind an end of it.
  std::optional<NearestLmd> at(const Pose& X_WM, double cutoff) const;

 private:
  const Scene& scene_;
  bool are_solids_;
};

}  // namespace lmdbench::completeness
