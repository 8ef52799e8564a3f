// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/agreement.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lmdbench::experiments {

/// Ground truth at each pose.
using Truth = std::vector<LmdSet>;

Truth exhaustive_truth(const Scene& scene, const std::vector<Pose>& poses);

/// Minimum distances closer than this, relative, are equal: FCL's own tolerance in this project.
inline constexpr double MINIMUM_TOLERANCE = 1e-6;

/// The error that the time of an implementation bought, over all poses.
struct LmdError {
  std::string objection;           ///< Why it must not be timed; empty when it does what it promises.
  Agreement same;                  ///< Same features; empty counts for peers without an LMD set.
  Agreement neighbours;            ///< Neighbouring features count.
  std::size_t minimum_missed = 0;  ///< Poses where the minimum distance is not the true one.
  /// Largest relative overestimate of the minimum distance; infinite where nothing was
  /// found though there was an LMD.
  double worst_minimum_error = 0.0;

  /// Adds one pose. A pose without a true LMD within the cutoff says nothing about the minimum distance and
  /// is left out of it.
  /// @param where   names the pose in objections
  /// @param lmds    what was found; null for peers that find a nearest pair only
  /// @param minimum smallest distance that was found [m]; NaN for none
  void add(Promise promise, const std::string& where, const Scene& scene, const LmdSet& truth,
           const LmdSet* lmds, double minimum);
};

}  // namespace lmdbench::experiments
