// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/completeness/study.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench::completeness {

/// What carries the scene's distance from the origin.
enum class FarCarrier : std::uint8_t {
  POSE,         ///< The fixed mesh is far away, and the pose moves the moving one there.
  BOTH_MESHES,  ///< Both meshes have large coordinates.
  MOVING_MESH,  ///< The moving mesh alone has them; the pose brings it back to the fixed one at the origin.
};

/// Two small meshes far from the origin of the world or of their own frame. What rounds are
/// coordinates of size 1, the offset: that is the scale.
struct FarScene : GeneratedScene {
  double diagonal = 0.0;  ///< Of the fixed mesh [m].
};

/// Poses of one far scene.
inline constexpr std::size_t FAR_POSES_A_SCENE = 20;
/// Range of the sizes (diagonals), as shares of the offset; drawn uniformly on a logarithmic scale.
inline constexpr double SMALLEST_FAR_SIZE = 1e-10, LARGEST_FAR_SIZE = 1e-5;

/// Scene number `index`: generated shapes, a size between the limits above, gaps of 1e-4 to 100 sizes, and
/// a cutoff of up to three gaps. Half of the scenes have unrelated poses, half follow a slow motion, as a
/// coherent search wants it; in two fifths of them the meshes are all but parallel. The scene depends on its two arguments alone.
FarScene make_far_scene(std::uint64_t seed, std::size_t index);

/// The judgements of all far scenes whose sizes have the same power of ten.
struct FarResult {
  int decade = 0;                     ///< Sizes of 10^decade up to 10^(decade + 1) of the offset.
  std::vector<Judgement> judgements;  ///< In the order of `variants()`.
};

/// Judges every variant at `poses` poses of far scenes, rounded up to whole scenes.
std::vector<FarResult> judge_far_scenes(std::uint64_t seed, std::size_t poses, const Complain& complain);

}  // namespace lmdbench::completeness
