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

/// The scene of a result, restored for pictures of it: meshes, poses, exact LMD sets.
namespace lmdbench {

/// The meshes of a result as placed in the scene, under the largest cutoff of its methods.
struct ResultScene {
  Scene rest;
  SceneMotion motion;      ///< Movers with their poses of the result.
  std::size_t frames = 0;  ///< Of the path; at least one.
};
/// Searches files in the working folder, the result's and the run's; the bytes must be the run's.
/// @throws InputError where a mesh is missing or differs from the run's, or there is no frame;
/// UsageError where the result's experiment is invalid
ResultScene scene_of_result(const ResultReader& result);

/// Poses of methods of a result.
struct ResultTrack {
  std::string method;               ///< Label of the method with this device; empty: all.
  std::vector<std::size_t> frames;  ///< Numbers of the frames.
  Path poses;                       ///< One a frame.
};

/// The path, or in a closed loop the poses of each method's device.
/// @param most_frames evenly spread frames, over all tracks together
std::vector<ResultTrack> tracks_of_result(const ResultReader& result, std::size_t most_frames);

/// So many instances are drawn at most.
inline constexpr std::size_t MOST_DRAWN = 24;

/// Indices of the fixed meshes to draw, ascending: all, or beyond `MOST_DRAWN` instances those
/// whose boxes come nearest to the tracks.
std::vector<std::size_t> drawn_bodies(const Scene& scene, const std::vector<ResultTrack>& tracks);

/// A method that gives the true sets fast enough for every frame.
std::unique_ptr<Method> exact_method(const Scene& scene);

}  // namespace lmdbench
