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

/// A method's count under a name; 0 for a pair, which needs no broad phase.
std::uint64_t counted(const Method& method, const WorkCounters& counters, const std::string& name);

/// How the poses of frames follow each other.
enum class Frames : std::uint8_t {
  COHERENT,      ///< Along the path; tests are kept.
  FROM_SCRATCH,  ///< Along the path; `certified` keeps nothing.
  TELEPORT       ///< The same contact, each frame with another instance, anywhere.
};
const char* to_string(Frames frames);

struct CostChoice {
  std::vector<std::size_t> counts = {1, 10, 100, 1000, 10000};
  double spacing = 1.5;  ///< In diagonals of the mesh's box.
  std::size_t passes = 7;
  std::uint64_t seed = 1;
};

/// Results for one number of instances and one kind of frames; wall clock.
struct CostRow {
  std::size_t instances = 0;
  std::vector<double> seconds;  ///< Frames with instance 0 alone: least of the passes.
  double queries = 0.0;         ///< Of the broad phase, per frame; the rest likewise.
  double touched = 0.0;         ///< Pairs looked at, per frame.
  double searched = 0.0;        ///< Pairs whose meshes were searched, per frame.
  double node_pairs = 0.0;      ///< Per frame.
  std::size_t idle_frames = 0;  ///< Frames in which no pair was looked at.
  std::size_t frames = 0;       ///< Per pass.
  std::size_t other_sets = 0;   ///< Frames where the world adds LMDs.
};

/// Cost of a world before its first frame.
struct PreparationRow {
  std::size_t instances = 0;
  double seconds = 0.0;  ///< Of list and method, of a prepared mesh; least of three, wall clock.
  double bytes = 0.0;    ///< Of both.
};

/// Runs the path against instance 0 of worlds of all sizes, which take turns frame by frame.
/// @param mesh of the instances; about the origin where the path passes it
/// @param poses X_WM along a contact with a mesh at the origin
std::vector<CostRow> measure_frames(const std::shared_ptr<const Body>& moving,
                                    const std::shared_ptr<const Body>& mesh, double cutoff,
                                    const std::vector<Pose>& poses, Frames frames, const CostChoice& choice);

std::vector<PreparationRow> measure_preparation(const std::shared_ptr<const Body>& moving,
                                                const std::shared_ptr<const Body>& mesh, double cutoff,
                                                const CostChoice& choice);

}  // namespace lmdbench::worlds
