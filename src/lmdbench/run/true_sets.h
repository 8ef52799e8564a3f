// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/run/prepare.h>
#include <lmdbench/run/truth_probe.h>

#include <cstdint>
#include <vector>

/// Truth in every frame. A probe on a stride sees every tenth event: rare jumps of the true force are missed and the
/// methods look worse, or better, than they are. `certified` gives the true set in microseconds; `exhaustive`, which
/// shares no search code with it, is asked at some frames whether that stands in this scene, too.
namespace lmdbench {

struct TrueSets {
  std::vector<LmdSet> sets;         ///< One a frame.
  std::int64_t checked_frames = 0;  ///< Compared with the exhaustive set.
  std::int64_t wrong_frames = 0;    ///< Of these, with another set of feature pairs.
};

/// @param checks   frames to compare with the exhaustive set, evenly spread; all where there are fewer
/// @param progress may stop by returning false, which throws Interrupted
TrueSets true_sets(const PreparedRun& run, std::int64_t checks, const Progress& progress);

/// The true forces of the sets at the frames from `first` on that have a next one.
/// @param run whose profile and device render
std::vector<TruthFrame> truth_frames(const TrueSets& truth, const PreparedRun& run, std::int64_t first);

}  // namespace lmdbench
