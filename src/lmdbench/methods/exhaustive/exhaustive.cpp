// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/lmd/triangle_pair.h>
#include <lmdbench/methods/exhaustive/exhaustive.h>

#include <utility>

namespace lmdbench {

Exhaustive::Exhaustive(Scene scene) : scene_(std::move(scene)), flat_pieces_(scene_) {
  grids_.reserve(scene_.fixed.size());
  for (const auto& body : scene_.fixed) grids_.emplace_back(body->surface().mesh);
}

void Exhaustive::search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  const RigidTransform transform(X_WM);
  const Surface& moving = scene_.moving->surface();
  const double squared_cutoff = scene_.cutoff * scene_.cutoff;
  minima_.clear();
  intersections_.clear();
  flat_pieces_.clear();

  const auto triangle_count = static_cast<std::int32_t>(moving.mesh.triangles.size());
  for (std::int32_t t_moving = 0; t_moving < triangle_count; ++t_moving) {
    const Triangle a = transform.triangle(moving.mesh.triangle(t_moving));
    const Eigen::AlignedBox3d box = bounding_box(a);
    for (std::size_t body = 0; body < grids_.size(); ++body) {
      const Surface& fixed = scene_.fixed[body]->surface();
      grids_[body].for_each_near(box, scene_.cutoff, [&](std::int32_t t_fixed) {
        ++counters[Counter::LEAF_PAIRS];
        ++counters[Counter::TRIANGLE_DISTANCES];
        const TrianglePairDistance pair = triangle_distance(a, fixed.mesh.triangle(t_fixed));
        if (!(pair.squared_distance <= squared_cutoff)) {
          ++counters[Counter::REJECTED_CUTOFF];
          return;
        }
        LocalMinimum minimum =
            minimum_of_triangle_pair(moving, fixed, static_cast<std::int32_t>(body), t_moving, t_fixed, pair);
        flat_pieces_.offer(transform, static_cast<std::int32_t>(body), t_moving, t_fixed);
        ++counters[Counter::FIRST_ORDER_TESTS];
        if (meets_first_order(moving, transform, fixed, minimum)) minima_.push_back(minimum);
      });
    }
  }
  flat_pieces_.append_parallel(minima_);
  merge_plateaus(scene_, transform, minima_, intersections_, lmds);
}

}  // namespace lmdbench
