// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/intersection_tracer.h>

namespace lmdbench {

IntersectionTracer::IntersectionTracer(const Scene& of_pair) : frame_(of_pair), certified_(frame_.scene()) {
  certified_.list_intersecting_pairs();
}

const std::vector<IntersectionPolyline>& IntersectionTracer::trace(const Pose& X_WM) {
  const Pose near = frame_.to_near(X_WM);
  WorkCounters ignored;
  certified_.search(near, lmds_, ignored);
  pairs_.clear();
  certified_.for_each_intersecting_pair([&](const CrossingPair& pair) { pairs_.push_back(pair); });
  polylines_.clear();
  append_polylines(frame_.scene().moving->surface(), RigidTransform(near),
                   frame_.scene().fixed_body().surface(), pairs_, polylines_);
  for (IntersectionPolyline& line : polylines_)
    for (Vec3& point : line.points) point += frame_.origin_W();
  return polylines_;
}

}  // namespace lmdbench
