// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/scene.h>

#include <vector>

namespace lmdbench {

/// "In contact", the one definition: at each pose, whether the meshes are within the cutoff of each other, so
/// that there is something to feel. A fact of the scene and the path alone: statistics over the frames in
/// contact are over the same frames for every method, whatever it found. Triangles that intersect or touch at
/// distance 0 are "touching", a part of it.
/// @param forecast  whether frames that follow from an earlier one and a bound on the motion since are left out of the
///                  search: the answer is the same
std::vector<bool> frames_in_contact(const Scene& scene, const std::vector<Pose>& poses, bool forecast = true);

/// Exact minimum distance [m] to any of the fixed meshes, however far; 0 where triangles touch or intersect.
double clearance(const Scene& scene, const Pose& X_WM);

}  // namespace lmdbench
