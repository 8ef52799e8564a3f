// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/intersection_polylines.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/run/lockstep.h>
#include <lmdbench/run/records.h>

#include <cstdint>
#include <vector>

/// The curves in which the meshes intersect, on a stride of frames and outside the timed ones.
namespace lmdbench {

struct PolylineFrame {
  std::int64_t frame = 0;
  double seconds = UNSET;  ///< Of the walk and the chaining, on this thread's clock.
  std::vector<IntersectionPolyline> polylines;
};

/// @throws Interrupted when `progress` asks to stop
std::vector<PolylineFrame> probe_polylines(const Scene& scene, const LockstepInput& input,
                                           const std::vector<std::int64_t>& frames, const Progress& progress);

}  // namespace lmdbench
