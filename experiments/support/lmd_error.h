// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/geometry/pose.h>
#include <lmdbench/lmd/agreement.h>
#include <lmdbench/lmd/method_description.h>
#include <lmdbench/lmd/scene.h>

#include <cstddef>
#include <string>
#include <vector>

namespace lmdbench::experiments {

/// True LMD set at each pose.
using Truth = std::vector<LmdSet>;

Truth exhaustive_truth(const Scene& scene, const std::vector<Pose>& poses);

/// Minimum distances closer than this, relative, are equal: FCL's own tolerance in this project.
inline constexpr double MINIMUM_TOLERANCE = 1e-6;

/// The error of an implementation over all poses, reported beside its time.
struct LmdError {
  std::string objection;           ///< Why it must not be timed, or empty.
  Agreement same;                  ///< Same features; no counts for peers without an LMD set.
  Agreement neighbours;            ///< Neighbouring features count.
  std::size_t minimum_missed = 0;  ///< Poses where the minimum distance is wrong.
  /// Largest relative overestimate of the minimum distance; infinite where an LMD exists and
  /// nothing was found.
  double worst_minimum_error = 0.0;

  /// Adds one pose. Its minimum distance is not judged without a true LMD within the cutoff.
  /// @param where   names the pose in objections
  /// @param lmds    the set found; null for peers that find a nearest pair only
  /// @param minimum smallest distance found [m]; NaN for none
  void add(Promise promise, const std::string& where, const Scene& scene, const LmdSet& truth,
           const LmdSet* lmds, double minimum);
};

}  // namespace lmdbench::experiments
