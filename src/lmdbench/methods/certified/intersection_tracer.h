// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/intersection_polylines.h>
#include <lmdbench/lmd/near_frame.h>
#include <lmdbench/methods/certified/certified.h>

#include <vector>

namespace lmdbench {

/// The curves in which two bodies intersect: `certified` gives the pairs of triangles that
/// intersect, and these are chained. Along a path the search is coherent.
class IntersectionTracer {
 public:
  /// @param of_pair  `Scene::is_pair`; its cutoff does not change the result
  explicit IntersectionTracer(const Scene& of_pair);

  /// @return polylines in world coordinates, valid until the next call
  const std::vector<IntersectionPolyline>& trace(const Pose& X_WM);

 private:
  NearFrame frame_;
  Certified certified_;
  LmdSet lmds_;
  std::vector<CrossingPair> pairs_;
  std::vector<IntersectionPolyline> polylines_;
};

}  // namespace lmdbench
