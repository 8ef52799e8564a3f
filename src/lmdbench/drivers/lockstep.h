// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/progress.h>
#include <lmdbench/drivers/records.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/prepare/driver_input.h>

#include <vector>

/// The lockstep driver: one clock instead of threads, so results depend on the scene alone, and the
/// staleness that threads cause is a given number of frames. A frame (paper, sections 4.3 and 5):
/// 0. Other movers go to this frame's place. Bodies that deform get its vertices and their
///    preparations follow: part of the local update's time, also kept apart.
/// 1. A search whose latency is over arrives: its set is tracked to this pose (second tracking) and
///    replaces the working set.
/// 2. Every `search_every_frames` a global search starts at this pose, with the first tracking
///    (reduction) at the same pose. With latency 0 it arrives at once.
///  3. The local part tracks the working set to this frame's pose.
///  4. LMDs within the cutoff are summed into a force, which the device clips.
///  5. In a closed loop the device moves until the next frame, whose pose is the device's.
/// Methods without local tracking search in every frame instead.
namespace lmdbench {

class RunKeeper;

/// Runs every method along all poses (in a closed loop on its own device), `repetitions` times.
/// Methods take turns in blocks, in random order, so that drifts of speed and caches hit all alike;
/// each repetition has fresh instances.
/// @param keeper keeps frames as they are measured, knows those of an interrupted run; or nullptr
/// @throws Error with ExitCode::INTERNAL when a repetition's forces, LMDs or counters differ from
///         those of the first one
std::vector<MethodRecord> run_lockstep(const std::vector<DrivenMethod>& methods, const DriverInput& input,
                                       const DriverChoice& driver, const Progress& progress,
                                       RunKeeper* keeper = nullptr);

}  // namespace lmdbench
