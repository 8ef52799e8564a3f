// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>
#include <lmdbench/motion/path.h>
#include <lmdbench/prepare/scene_frames.h>
#include <lmdbench/result_file/result_reader.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

/// The scene of a result found again, for pictures of it: meshes, poses, exact LMD sets.
namespace lmdbench {

/// The meshes of a result as they stood in the scene, under the largest cutoff of its methods.
struct ResultScene {
  Scene rest;
  SceneMotion motion;  ///< Movers with the poses that the result has.
};
/// The run's files are looked for from the working folder, beside the result file and from the folder of the run, and taken only with the
/// bytes that were run.
/// @throws InputError where a mesh is not to be had any more or is no longer what was run; UsageError where the result's
/// experiment is none
ResultScene scene_of_result(const ResultReader& result);

/// Poses that methods of a result went through.
struct ResultTrack {
  std::string method;  ///< Label of the one method whose device this is; empty: all methods share it.
  std::vector<std::size_t> frames;  ///< Numbers of the frames.
  Path poses;                       ///< One a frame.
};

/// The path, or in a closed loop the poses of each method's device.
/// @param most_frames evenly spread frames, of all tracks together
std::vector<ResultTrack> tracks_of_result(const ResultReader& result, std::size_t most_frames);

/// At most so many instances of a world are drawn.
inline constexpr std::size_t MOST_DRAWN = 24;

/// Indices of the fixed meshes that are worth drawing, ascending: all of them, or of a world with more than `MOST_DRAWN` those whose boxes
/// come nearest to the tracks.
std::vector<std::size_t> drawn_bodies(const Scene& scene, const std::vector<ResultTrack>& tracks);

/// The method whose sets are the truth at a price that every frame can pay.
std::unique_ptr<Method> exact_method(const Scene& scene);

}  // namespace lmdbench
