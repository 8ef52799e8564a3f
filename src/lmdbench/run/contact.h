// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/scene.h>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace lmdbench {

/// "In contact", the one definition: at each pose, whether the meshes are within the cutoff of each other, so
/// that there is something to feel. A fact of the scene and the path alone: statistics over the frames in
/// contact are over the same frames for every method, whatever it found. Triangles that intersect or touch at
/// distance 0 are "touching", a part of it.
/// @param forecast  whether frames that follow from an earlier one and a bound on the motion since are left out of the
///                  search: the answer is the same
std::vector<bool> frames_in_contact(const Scene& scene, const std::vector<Pose>& poses, bool forecast = true);

/// Exact minimum distance to the fixed meshes, none of which is placed [m]; 0 where triangles touch or intersect, infinite where none
/// is within the bound.
/// @param bound distances above this are not looked for [m]
double nearest_distance(const Scene& scene, const Pose& X_WM,
                        double bound = std::numeric_limits<double>::infinity());

/// Distances of the meshes along a path.
struct Clearance {
  double least_m =
      std::numeric_limits<double>::infinity();  ///< Exact, however far; 0 where triangles touch or intersect.
  std::int64_t touching = 0;                    ///< Poses at which they touch or intersect.
};

/// Of all poses. Looked at are those whose distance, by a bound on the motion since the last look, could be less than the least so
/// far: the answer is that of a look at each.
Clearance clearance(const Scene& scene, std::span<const Pose> poses);

}  // namespace lmdbench
