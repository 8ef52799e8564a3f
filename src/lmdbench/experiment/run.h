// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/complete_truth.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/experiment/fcl_probe.h>
#include <lmdbench/experiment/lockstep.h>
#include <lmdbench/experiment/plan.h>
#include <lmdbench/experiment/polyline_probe.h>
#include <lmdbench/experiment/prepare.h>
#include <lmdbench/experiment/realtime_record.h>
#include <lmdbench/experiment/records.h>
#include <lmdbench/experiment/run_keeper.h>
#include <lmdbench/experiment/truth_probe.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {

/// Poses under one force profile, with what is known of them beside any method's opinion. In an open loop the methods of a
/// profile share one; in a closed one each has its own, since its device takes its own path.
struct Track {
  std::size_t profile = 0;                ///< Of the experiment.
  std::vector<std::size_t> methods;       ///< Which of the experiment's methods went along it.
  std::vector<bool> in_contact;           ///< One a frame (contact.h).
  std::vector<TruthFrame> truth;          ///< Empty where the plan leaves the probe out.
  std::optional<CompleteTruth> complete;  ///< Truth of every frame, where one of `methods` gives it.
  std::optional<FclCheck> fcl;            ///< Its columns are those of `methods`.
  std::vector<PolylineFrame> polylines;   ///< Empty where the plan leaves them out.
};

/// Everything that a run produced, in memory.
struct RunResult {
  Plan plan;
  PreparedRun prepared;
  std::vector<MethodRecord> records;   ///< In the order of the experiment's methods, like the next two.
  std::vector<RealtimeRecord> clocks;  ///< Of the driver realtime; else empty.
  std::vector<std::size_t> track_of_method;
  std::vector<std::vector<TruthComparison>> comparisons;  ///< One list a method, one entry a TruthFrame.
  std::vector<Track> tracks;
  bool one_track = false;             ///< All methods see the poses of the path under one profile.
  std::vector<bool> in_contact;       ///< One a frame of the path, under the first profile's cutoff.
  std::vector<std::string> warnings;  ///< What a reader of the result must know, in plain words.
  std::int64_t resumed_frames =
      0;  ///< Whose times an interrupted run measured, over methods and repetitions.

  const Track& track_of(std::size_t method) const { return tracks[track_of_method[method]]; }
};

/// What a run reports while it goes on: the phase ("run", "truth", "fcl", "polylines"), what is done and what there is to
/// do. False stops the run after the current block.
using RunProgress = std::function<bool(const std::string& phase, std::int64_t done, std::int64_t total)>;

/// Runs an experiment in memory.
/// @throws Interrupted when `progress` returned false
RunResult run_experiment(const Experiment& experiment, const RunProgress& progress = {});

/// Runs it and leaves a result file, which takes its name only when it is complete: an earlier file of that
/// name stays whole until then. A file that cannot be written is noticed before the run, not after it. While it
/// runs, `<file>.part` holds every frame that was measured (RunKeeper): whatever ends the run, they stay there,
/// and `Leftover::RESUME` goes on with them.
/// @throws Interrupted when `progress` returned false
/// @throws EnvironmentError when the part holds what an interrupted run measured and shall not be resumed
RunResult run_experiment_to_file(const Experiment& experiment, const std::filesystem::path& file,
                                 const std::vector<std::string>& argv, const RunProgress& progress = {},
                                 Leftover leftover = Leftover::REFUSE);

}  // namespace lmdbench
