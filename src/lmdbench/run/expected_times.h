// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/run/prepare.h>
#include <lmdbench/run/scene_look.h>

#include <vector>

namespace lmdbench {

/// Frames of the path at which a search is timed.
inline constexpr std::int64_t TIMED_FRAMES = 8;

/// What a run will take, from searches at a few frames: each method's searches from scratch (tracking, coherence
/// and FCL are not in it) and the truth probe. Good to a factor of a few.
std::vector<ExpectedTime> expected_times(const Experiment& experiment, const PreparedRun& prepared);

}  // namespace lmdbench
