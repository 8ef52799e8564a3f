// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/body.h>

#include <support/random.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace lmdbench::experiments {

/// Poses X_WM at which the moving body is `gap` away from the fixed one: a random orientation,
/// approached along a random line through both centres. The first pose depends on the seed alone.
/// @param gap wanted minimum distance [m], positive; reached to within `GAP_TOLERANCE` of itself
/// @throws std::runtime_error when a line misses the fixed body (with a hole through the centre)
std::vector<Pose> grazing_poses(const Body& moving, const Body& fixed, double gap, std::size_t count,
                                std::uint64_t seed);

/// Consecutive poses of a recorded path (TUM file) at 1 kHz, as the experiments use them.
/// @param first  frame of the first pose
/// @throws InputError for an unreadable file; std::runtime_error when the path is too short
std::vector<Pose> path_poses(const std::filesystem::path& file, std::size_t first, std::size_t count);

/// Frames of a trembling hand: each steps in a random direction and turns about a random axis.
/// @param step  metres a frame
/// @param turn  radians a frame, about the moving mesh's origin
std::vector<Pose> trembling_poses(const Pose& begin, double step, double turn, std::size_t count,
                                  Random& random);

/// Relative to the gap, and far below what any method resolves.
inline constexpr double GAP_TOLERANCE = 1e-6;

}  // namespace lmdbench::experiments
