// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench::worlds {

/// One broad phase among randomly turned cubes, as dense as a crowd, and one cube that moves.
struct BroadPhaseRow {
  std::string name;
  std::size_t instances = 0;
  double build_seconds = 0.0;        ///< Least of three.
  double bytes = 0.0;                ///< Per instance.
  std::vector<double> seconds;       ///< Per frame, straight in small steps: least of the passes.
  std::vector<double> jump_seconds;  ///< One per frame, at unrelated places.
  std::size_t wrong = 0;             ///< Frames in which it missed an instance within reach.
};

/// "boost" (packed R-tree), "fcl" (dynamic AABB tree), "embree" if built (user boxes, point query),
/// "brute force" (every box), and "kept", which worlds use: the R-tree with kept candidates.
std::vector<BroadPhaseRow> compare_broad_phases(std::size_t instances, std::size_t frames, std::size_t passes,
                                                std::uint64_t seed);

/// Cost of a slack on the same boxes and way.
struct SlackRow {
  double slack = 0.0;    ///< Over the radius of the moving cube.
  double queries = 0.0;  ///< Per frame.
  double touched = 0.0;  ///< Instances per frame.
  double seconds = 0.0;  ///< Mean over frames: least of the passes.
};
SlackRow measure_slack(double slack, std::size_t instances, std::size_t frames, std::size_t passes,
                       std::uint64_t seed);

}  // namespace lmdbench::worlds
