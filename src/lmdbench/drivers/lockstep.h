// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/progress.h>
#include <lmdbench/drivers/records.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/prepare/driver_input.h>

#include <vector>

/// The lockstep driver: one clock instead of threads, so that results depend on the scene alone, while the
/// staleness that threads would cause is an explicit number of frames. A frame does what the paper's threads
/// would (sections 4.3 and 5):
///  0. What else moves goes to this frame's place. Where meshes deform the method's own bodies get this frame's vertices, and what was
///     prepared of them follows: a part of the frame's local update, whose share of it is kept apart as well.
///  1. A search whose latency is over arrives: its set is tracked to this frame's pose (second tracking) and
///     replaces the working set.
///  2. Every `search_every_frames` a global search starts at this frame's pose, followed by the first
///     tracking (reduction) at the same pose. With a latency of 0 it arrives at once.
///  3. The local part tracks the working set to this frame's pose.
///  4. LMDs within the cutoff are summed into a force, which the device clips.
///  5. In a closed loop the device moves until the next frame, whose pose is the device's.
/// Methods without local tracking search in every frame instead.
namespace lmdbench {

class RunKeeper;

/// Runs every method along all poses (in a closed loop: each on a device of its own), `repetitions` times. Methods take turns block by block, in random
/// order, so that drifts of the machine's speed and what another method leaves in the caches hit all alike; every repetition starts from fresh instances.
/// @param keeper keeps every frame as it is measured and knows those of an interrupted run; may be nullptr
/// @throws Error with ExitCode::INTERNAL when a repetition's forces, LMDs or counters differ from the
///         first one's
std::vector<MethodRecord> run_lockstep(const std::vector<DrivenMethod>& methods, const DriverInput& input,
                                       const DriverChoice& driver, const Progress& progress,
                                       RunKeeper* keeper = nullptr);

}  // namespace lmdbench
