// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/completeness/study.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench::completeness {

/// What carries the scene's distance from the origin.
enum class FarCarrier : std::uint8_t {
  POSE,         ///< The fixed mesh is far away; the pose brings the moving one to it.
  BOTH_MESHES,  ///< Both meshes have large coordinates.
  MOVING_MESH,  ///< Only the moving mesh has them; the pose brings it back to the origin.
};

/// Two small meshes far from the origin of the world or of their own frame. The offset, of length
/// 1, is the scale: coordinates of that size are what is rounded.
struct FarScene : GeneratedScene {
  double diagonal = 0.0;  ///< Of the fixed mesh [m].
};

/// Number of poses of one far scene.
inline constexpr std::size_t FAR_POSES_A_SCENE = 20;
/// Limits of the sizes (diagonals), as shares of the offset; sizes are log-uniform.
inline constexpr double SMALLEST_FAR_SIZE = 1e-10, LARGEST_FAR_SIZE = 1e-5;

/// Scene number `index`: generated shapes, a size between the limits above, gaps of 1e-4 to 100
/// sizes, a cutoff of up to three gaps. Half have unrelated poses, half a slow motion for frame
/// coherence. In two fifths the meshes are almost parallel. Depends on both arguments alone.
FarScene make_far_scene(std::uint64_t seed, std::size_t index);

/// The judgements of all far scenes whose sizes lie in one decade.
struct FarResult {
  int decade = 0;                     ///< Sizes of 10^decade up to 10^(decade + 1) of the offset.
  std::vector<Judgement> judgements;  ///< In the order of `variants()`.
};

/// Judges every variant at `poses` poses of far scenes, rounded up to whole scenes.
std::vector<FarResult> judge_far_scenes(std::uint64_t seed, std::size_t poses, const Complain& complain);

}  // namespace lmdbench::completeness
