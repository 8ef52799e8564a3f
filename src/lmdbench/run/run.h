// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/experiment/experiment.h>
#include <lmdbench/run/complete_truth.h>
#include <lmdbench/run/fcl_probe.h>
#include <lmdbench/run/lockstep.h>
#include <lmdbench/run/plan.h>
#include <lmdbench/run/polyline_probe.h>
#include <lmdbench/run/prepare.h>
#include <lmdbench/run/realtime_record.h>
#include <lmdbench/run/records.h>
#include <lmdbench/run/run_keeper.h>
#include <lmdbench/run/truth_probe.h>

#include <cstdint>
#include <functional>
#include <memory>
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

/// Makes what keeps the frames of a prepared run.
using MakeKeeper = std::function<std::unique_ptr<RunKeeper>(const RunResult&, std::int64_t frames)>;

/// Runs an experiment in memory.
/// @param make_keeper none for a run that nobody takes up again
/// @throws Interrupted when `progress` returned false
RunResult run_experiment(const Experiment& experiment, const RunProgress& progress = {},
                         const MakeKeeper& make_keeper = {});

}  // namespace lmdbench
