// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/geometry/triangle_distance.h>
#include <lmdbench/lmd/triangle_pair.h>
#include <lmdbench/methods/nearest/nearest.h>

#include <utility>

namespace lmdbench {

Nearest::Nearest(Scene of_pair, const NearestOptions& options)
    : scene_(std::move(of_pair)),
      warm_start_(options.warm_start),
      fcl_(scene_.moving->surface(), {&scene_.fixed_body().surface()}) {}

void Nearest::search(const Pose& X_WM, LmdSet& lmds, WorkCounters& counters) {
  lmds.clear();
  ++counters[Counter::FCL_QUERIES];
  const FclResult found = warm_start_ ? fcl_.distance_warm(X_WM) : fcl_.distance(X_WM);
  if (!(found.distance <= scene_.cutoff)) return;

  const Surface& moving = scene_.moving->surface();
  const Surface& fixed = scene_.fixed_body().surface();
  ++counters[Counter::TRIANGLE_DISTANCES];
  const TrianglePairDistance exact =
      triangle_distance(RigidTransform(X_WM).triangle(moving.mesh.triangle(found.triangle_moving)),
                        fixed.mesh.triangle(found.triangle_fixed));
  Lmd lmd = lmd_of_triangle_pair(moving, fixed, found.triangle_moving, found.triangle_fixed, exact);
  if (found.separated) {
    lmd.point_moving = found.point_moving;
    lmd.point_fixed = found.point_fixed;
    lmd.distance = (lmd.point_fixed - lmd.point_moving).norm();
    lmd.intersecting = false;
  }
  if (lmd.distance > 0.0 && !lmd.intersecting)
    lmd.direction = (lmd.point_fixed - lmd.point_moving) / lmd.distance;
  lmds.push_back(lmd);
}

}  // namespace lmdbench
