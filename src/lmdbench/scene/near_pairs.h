// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/scene.h>

#include <vector>

namespace lmdbench {

/// Largest distance of a contact of any two objects: cutoff and tolerances [m].
double contact_reach(const Scene& scene);

/// Pairs of objects whose bounding spheres are within a distance of each other, nearest first.
class NearPairs {
 public:
  struct Pair {
    double at_least = 0.0;  ///< Bound of the distance [m].
    ObjectPair objects;
  };
  /// @param scene must outlive this
  explicit NearPairs(const Scene& scene) : scene_(scene) {}

  /// Looks at all pairs: truth shares no broad phase with what it judges.
  const std::vector<Pair>& within(double distance, const Pose& X_WM);

 private:
  const Scene& scene_;
  std::vector<Vec3> centres_;
  std::vector<double> radii_, rounding_;
  std::vector<Pair> pairs_;
};

}  // namespace lmdbench
