// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/scene.h>

#include <study/completeness/study.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench::completeness {

/// How the coordinates of a flat scene's meshes come about.
enum class FlatCoordinates : std::uint8_t {
  AS_MADE,  ///< Faces square to the axes, to the bit.
  TURNED,   ///< Both meshes turned apart at random; the coordinates are doubles.
  FLOATS,   ///< The same, rounded to single precision and flattened as an import does it.
};

/// Two meshes with flat faces, lying on each other a small gap apart.
struct FlatScene {
  std::string label;
  Scene scene;              ///< With its cutoff.
  double diagonal = 0.0;    ///< Of the fixed mesh [m].
  std::vector<Pose> poses;  ///< World pose of the moving mesh.
};

/// Poses of one flat scene: half of the scenes have unrelated ones, half slide.
inline constexpr std::size_t FLAT_POSES_A_SCENE = 20;

/// Names of the pairs of shapes: plates, boxes, plates with holes, non-convex faces with several overlaps, edges.
std::vector<std::string> flat_pairs();

/// Scene number `index` of a pair. A side of the moving mesh lies over the upper side of the fixed one, in a direction
/// of the axes or in any; the scene depends on the arguments alone.
FlatScene make_flat_scene(std::size_t pair, FlatCoordinates coordinates, std::uint64_t seed,
                          std::size_t index);

/// The judgements of all scenes of a pair with one kind of coordinates, in the order of `variants()`.
struct FlatResult {
  std::string pair;
  FlatCoordinates coordinates = FlatCoordinates::AS_MADE;
  std::vector<Judgement> judgements;
};

/// Judges every variant at `poses` poses of each pair and kind of coordinates, rounded up to whole scenes.
std::vector<FlatResult> judge_flat_scenes(std::uint64_t seed, std::size_t poses, const Complain& complain);

const char* name_of(FlatCoordinates coordinates);

}  // namespace lmdbench::completeness
