// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/scene.h>
#include <lmdbench/world/broad_phase.h>

#include <cstdint>
#include <limits>

namespace lmdbench {

/// The nearest of a world's instances.
struct NearestInstance {
  std::int32_t instance = -1;                                 ///< -1 where none is within the bound.
  double distance = std::numeric_limits<double>::infinity();  ///< [m]; 0 where the meshes intersect.
};

/// Exact minimum distance to a scene's fixed meshes, each at its pose (snch/minimum_distance.h), nearest boxes first. Of instances that
/// are equally near the first by index.
/// @param phase of the same scene
/// @param bound distances above this are not looked for [m]
NearestInstance nearest_instance(const Scene& scene, const BroadPhase& phase, const Pose& X_WM,
                                 double bound = std::numeric_limits<double>::infinity());

}  // namespace lmdbench
