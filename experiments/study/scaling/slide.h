// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/body.h>
#include <lmdbench/lmd/method.h>

#include <support/random.h>

#include <memory>
#include <vector>

namespace lmdbench::scaling {

/// Motion of the recorded bunny paths per frame while they slide: 27 mm/s and 35 degrees a second
/// at a diagonal of 0.15 m and 1 kHz.
inline constexpr double SLIDE_DIAGONALS_PER_FRAME = 0.00018;
inline constexpr double TURN_RAD_PER_FRAME = 0.00061;

/// Frames of a slide that ends at `end`, tangential to the nearest pair there, in a random
/// direction, with a random turn about that pair. The last entry is one frame before `end`.
/// @param diagonal of the moving body [m]
std::vector<Pose> lead_in(const Body& moving, const Body& fixed, const Pose& end, double diagonal,
                          std::size_t frames, experiments::Random& random);

/// A method with its last set.
struct Runner {
  std::unique_ptr<Method> method = nullptr;
  LmdSet lmds = {};
  WorkCounters counters = {};  ///< Of the last search.

  void search(const Pose& pose) {
    counters = WorkCounters{};
    method->search(pose, lmds, counters);
  }
};

}  // namespace lmdbench::scaling
