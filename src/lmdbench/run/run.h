// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/drivers/records.h>
#include <lmdbench/drivers/run_keeper.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/prepare/plan.h>
#include <lmdbench/prepare/prepare.h>
#include <lmdbench/probes/fcl_probe.h>
#include <lmdbench/probes/truth_probe.h>
#include <lmdbench/realtime/record.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// Poses under one force profile, with facts that depend on no method. In an open loop the methods
/// of a profile share one track; in a closed one each has its own, the path of its device.
struct Track {
  std::size_t profile = 0;           ///< Of the experiment.
  std::vector<std::size_t> methods;  ///< Indices of the experiment's methods with these poses.
  std::vector<bool> in_contact;      ///< One a frame (contact.h).
  /// Of the plan's probes, by name.
  std::map<std::string, std::unique_ptr<const ProbeFindings>, std::less<>> findings;

  /// Null where the plan has no such probe, or it looks at no frame.
  const TruthFindings* truth() const { return found<TruthFindings>("truth"); }
  const FclCheck* fcl() const { return found<FclCheck>("fcl"); }

 private:
  template <typename Findings>
  const Findings* found(std::string_view probe) const {
    const auto at = findings.find(probe);
    return at == findings.end() ? nullptr : static_cast<const Findings*>(at->second.get());
  }
};

/// All results of a run, in memory.
struct RunResult {
  Plan plan;
  PreparedRun prepared;
  std::vector<MethodRecord> records;   ///< In the experiment's order, as the next two.
  std::vector<RealtimeRecord> clocks;  ///< Of the driver realtime; else empty.
  std::vector<std::size_t> track_of_method;
  std::vector<Track> tracks;
  bool one_track = false;             ///< All methods share the path's poses and a profile.
  std::vector<bool> in_contact;       ///< One a frame, under the first profile's cutoff.
  std::vector<std::string> warnings;  ///< Facts for readers of the result, in plain words.
  /// Frames with times from an interrupted run, over all methods and repetitions.
  std::int64_t resumed_frames = 0;

  const Track& track_of(std::size_t method) const { return tracks[track_of_method[method]]; }
  /// Index of a method in its track.
  std::size_t place_of(std::size_t method) const;
  /// Of a method with truth, one for each TruthFrame; empty without the truth probe.
  const std::vector<TruthComparison>& comparisons(std::size_t method) const;
  /// Group of a track's datasets in the file: empty where all methods share it, else the method's.
  std::string group_of(const Track& track) const {
    return one_track ? "" : "/methods/" + records[track.methods.front()].label;
  }
};

/// Above this share of clipped frames in contact a run warns: clipped forces hide LMDs' effects.
inline constexpr double CLIPPED_SHARE = 0.1;

/// Unset where at most CLIPPED_SHARE of the frames in contact are clipped.
/// @param by_maximum the profile's own limit (`clip`: maximum) is below the device's
std::optional<SceneWarning> clipping_warning(const MethodRecord& record, const std::vector<bool>& in_contact,
                                             bool by_maximum);

/// Reports of a run in progress: the phase ("run", "truth", "fcl", "polylines"), work done and work
/// in all. False stops the run after the current block.
using RunProgress = std::function<bool(const std::string& phase, std::int64_t done, std::int64_t total)>;

/// Makes the object that keeps the frames of a prepared run.
using MakeKeeper = std::function<std::unique_ptr<RunKeeper>(const RunResult&, std::int64_t frames)>;

/// Runs an experiment in memory.
/// @param make_keeper none for a run that will not be resumed
/// @throws Interrupted when `progress` returned false
RunResult run_experiment(const Experiment& experiment, const RunProgress& progress = {},
                         const MakeKeeper& make_keeper = {});

}  // namespace lmdbench
