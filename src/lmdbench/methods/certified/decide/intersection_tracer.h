// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/decision/intersection_polylines.h>
#include <lmdbench/lmd/near_frame.h>
#include <lmdbench/methods/certified/certified.h>

#include <vector>

namespace lmdbench {

/// The curves in which two bodies intersect, out of the same walk that finds the LMD set: `certified`
/// leaves the pairs of triangles that intersect, and they are chained. Along a path the walk is coherent.
class IntersectionTracer {
 public:
  /// @param of_pair `Scene::is_pair`; its cutoff changes nothing in the result: the walk looks for LMDs up to it
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
