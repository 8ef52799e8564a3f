// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <study/completeness/study.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench::completeness {

/// How a mesh moves from pose to pose.
enum class Motion : std::uint8_t {
  NONE,     ///< Poses have nothing to do with each other.
  WALK,     ///< Each step in another direction.
  SLIDE,    ///< Steady, along an axis or in any direction, turning or not.
  TREMBLE,  ///< About one pose, by a rounding to a hundredth of the size.
  JUMPS,    ///< A slide that goes on elsewhere now and then, or there and back.
  THROUGH,  ///< To and fro through the surface.
  MIXED     ///< All of these and standing still, each for a while.
};
inline constexpr Motion ALL_MOTIONS[] = {Motion::NONE,  Motion::WALK,    Motion::SLIDE, Motion::TREMBLE,
                                         Motion::JUMPS, Motion::THROUGH, Motion::MIXED};
const char* name_of(Motion motion);

/// Poses of one hostile scene.
inline constexpr std::size_t HOSTILE_POSES_A_SCENE = 20, HOSTILE_FRAMES_A_SCENE = 100;

/// Scene number `index` of a motion: two hostile meshes (hostile_meshes.h), or one and its copy, of any size, the moving one
/// also far smaller than the other, at any distance from their frames' origins, from far apart over touch to deep in each other.
/// The scene depends on its arguments alone; its scale is that of the meshes' size and distance
/// from the origin.
GeneratedScene make_hostile_scene(Motion motion, std::uint64_t seed, std::size_t index);

/// Judges every variant at `poses` poses of a motion, rounded up to whole scenes; in the order of `variants()`.
std::vector<Judgement> judge_hostile_scenes(Motion motion, std::uint64_t seed, std::size_t poses,
                                            const Complain& complain);

}  // namespace lmdbench::completeness
