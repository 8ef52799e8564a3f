// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench::worlds {

/// What a method has counted under a name; 0 of a pair, which needs no broad phase.
std::uint64_t counted(const Method& method, const WorkCounters& counters, const std::string& name);

/// How a frame begins.
enum class Frames : std::uint8_t {
  COHERENT,      ///< Along the path, tests are kept.
  FROM_SCRATCH,  ///< Along the path, `certified` keeps nothing.
  TELEPORT       ///< Each frame at the same contact with another instance, anywhere.
};
const char* to_string(Frames frames);

struct CostChoice {
  std::vector<std::size_t> counts = {1, 10, 100, 1000, 10000};
  double spacing = 1.5;  ///< In diagonals of the mesh's box.
  std::size_t passes = 7;
  std::uint64_t seed = 1;
};

/// One number of instances, in one way of frames.
struct CostRow {
  std::size_t instances = 0;
  std::vector<double>
      seconds;  ///< One a frame with a contact of instance 0 alone: the least of the passes, wall clock.
  double queries = 0.0;         ///< Of the broad phase, a frame; as the following over all frames of a pass.
  double touched = 0.0;         ///< Pairs looked at, a frame.
  double searched = 0.0;        ///< Pairs whose meshes were searched, a frame.
  double node_pairs = 0.0;      ///< A frame.
  std::size_t idle_frames = 0;  ///< Frames in which no instance was looked at.
  std::size_t frames = 0;       ///< Of a pass.
  std::size_t other_sets = 0;   ///< Frames whose set is not that of one instance: others are near, too.
};

/// What a world costs before its first frame.
struct PreparationRow {
  std::size_t instances = 0;
  double seconds =
      0.0;  ///< To make the scene's list and the method, the mesh being prepared: least of three, wall clock.
  double bytes = 0.0;  ///< Of both.
};

/// Runs the path against instance 0 of worlds of all sizes, frame by frame in turns, so that whatever the machine does meets all alike.
/// @param mesh what stands; about the origin where the path passes it
/// @param poses X_WM along a contact with a mesh at the origin
std::vector<CostRow> measure_frames(const std::shared_ptr<const Body>& moving,
                                    const std::shared_ptr<const Body>& mesh, double cutoff,
                                    const std::vector<Pose>& poses, Frames frames, const CostChoice& choice);

std::vector<PreparationRow> measure_preparation(const std::shared_ptr<const Body>& moving,
                                                const std::shared_ptr<const Body>& mesh, double cutoff,
                                                const CostChoice& choice);

}  // namespace lmdbench::worlds
