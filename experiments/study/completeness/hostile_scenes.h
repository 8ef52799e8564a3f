// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/completeness/study.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lmdbench::completeness {

/// How a mesh moves from pose to pose.
enum class Motion : std::uint8_t {
  NONE,     ///< Unrelated poses.
  WALK,     ///< Each step goes in another direction.
  SLIDE,    ///< Steady, along an axis or in any direction, with or without a turn.
  TREMBLE,  ///< About one pose, by a rounding up to a hundredth of the size.
  JUMPS,    ///< A slide that now and then jumps elsewhere, or there and back.
  THROUGH,  ///< To and fro through the surface.
  MIXED,    ///< All of these and standing still, each for a while.
  LAID      ///< Unrelated poses, corner on corner and edge on edge (laid_poses.h).
};
inline constexpr Motion ALL_MOTIONS[] = {Motion::NONE,  Motion::WALK,    Motion::SLIDE, Motion::TREMBLE,
                                         Motion::JUMPS, Motion::THROUGH, Motion::MIXED, Motion::LAID};
inline bool is_without_motion(Motion motion) {
  return motion == Motion::NONE || motion == Motion::LAID;
}
const char* name_of(Motion motion);

/// Number of poses or frames of one hostile scene.
inline constexpr std::size_t HOSTILE_POSES_A_SCENE = 20, HOSTILE_FRAMES_A_SCENE = 100;

/// Scene number `index` of a motion: two hostile meshes (hostile_meshes.h) or one and its copy, of
/// any size, at any distance from the origins of their frames. The moving mesh may be far smaller.
/// Poses range from far apart over touch to deep overlap. The scene depends on its arguments alone.
/// Its scale is the sum of the fixed mesh's size and both distances.
GeneratedScene make_hostile_scene(Motion motion, std::uint64_t seed, std::size_t index);

/// Judges every variant, in the order of `variants()`; `poses` is rounded up to whole scenes.
std::vector<Judgement> judge_hostile_scenes(Motion motion, std::uint64_t seed, std::size_t poses,
                                            const Complain& complain);

}  // namespace lmdbench::completeness
