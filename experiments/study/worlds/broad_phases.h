// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench::worlds {

/// A broad phase among boxes: turned cubes at random, of the density of a crowd, and one that moves.
struct BroadPhaseRow {
  std::string name;
  std::size_t instances = 0;
  double build_seconds = 0.0;   ///< Least of three.
  double bytes = 0.0;           ///< An instance.
  std::vector<double> seconds;  ///< One a frame along a straight way of small steps: least of the passes.
  std::vector<double> jump_seconds;  ///< One a frame at unrelated places.
  std::size_t wrong = 0;  ///< Frames in which an instance whose cube is within reach was not reported.
};

/// "boost" (R-tree, packed), "fcl" (dynamic AABB tree), "embree" where the build has it (user boxes, a point query), "brute force" (every
/// box), and "kept": what worlds use, the R-tree with candidates that stay.
std::vector<BroadPhaseRow> compare_broad_phases(std::size_t instances, std::size_t frames, std::size_t passes,
                                                std::uint64_t seed);

/// What a slack costs on the same boxes and way.
struct SlackRow {
  double slack = 0.0;    ///< Over the radius of what moves.
  double queries = 0.0;  ///< A frame.
  double touched = 0.0;  ///< Instances, a frame.
  double seconds = 0.0;  ///< Mean of a frame: least of the passes.
};
SlackRow measure_slack(double slack, std::size_t instances, std::size_t frames, std::size_t passes,
                       std::uint64_t seed);

}  // namespace lmdbench::worlds
