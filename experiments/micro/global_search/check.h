// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <micro/global_search/implementation.h>
#include <micro/match.h>

#include <limits>
#include <string>
#include <vector>

namespace lmdbench::micro {

/// Ground truth at each pose.
using Truth = std::vector<LmdSet>;

Truth exhaustive_truth(const Scene& scene, const std::vector<Pose>& poses);

/// The error that the time of an implementation bought, over all poses.
struct SearchError {
  std::string objection;           ///< Why it must not be timed; empty when it does what it promises.
  MatchCount feature_pairs;        ///< Empty counts for peers without an LMD set.
  std::size_t minimum_missed = 0;  ///< Poses where the minimum distance is not the true one.
  /// Largest relative overestimate of the minimum distance; infinite where nothing was found though there was
  /// an LMD.
  double worst_minimum_error = 0.0;
};

/// Minimum distances closer than this, relative, are equal: FCL's own tolerance in this project.
inline constexpr double MINIMUM_TOLERANCE = 1e-6;

/// Runs the implementation at every pose and compares with truth. Poses without a true LMD within the cutoff
/// say nothing about the minimum distance and are left out of it.
SearchError check_search(const SearchImplementation& implementation, GlobalSearch& search, const Scene& scene,
                         const std::vector<Pose>& poses, const Truth& truth);

}  // namespace lmdbench::micro
