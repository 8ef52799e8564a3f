// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/certified/intersection_tracer.h>

#include <cstddef>

namespace lmdbench {

IntersectionTracer::IntersectionTracer(const Scene& scene)
    : frame_(scene), certified_(frame_.scene()), pairs_(scene.fixed.size()) {}

const std::vector<IntersectionPolyline>& IntersectionTracer::trace(const Pose& X_WM) {
  const Pose near = frame_.to_near(X_WM);
  WorkCounters ignored;
  certified_.search(near, lmds_, ignored);
  for (auto& of_body : pairs_) of_body.clear();
  certified_.for_each_intersecting_pair(
      [&](const CrossingPair& pair) { pairs_[static_cast<std::size_t>(pair.fixed_body)].push_back(pair); });
  polylines_.clear();
  const RigidTransform transform(near);
  const Scene& scene = frame_.scene();
  for (std::size_t body = 0; body < pairs_.size(); ++body)
    append_polylines(scene.moving->surface(), transform, scene.fixed[body]->surface(), pairs_[body],
                     polylines_);
  for (IntersectionPolyline& line : polylines_)
    for (Vec3& point : line.points) point += frame_.origin_W();
  return polylines_;
}

}  // namespace lmdbench
