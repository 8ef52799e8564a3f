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

/// Poses under one force profile, with what is known of them beside any method's opinion. In an open loop the methods of a
/// profile share one; in a closed one each has its own, since its device takes its own path.
struct Track {
  std::size_t profile = 0;           ///< Of the experiment.
  std::vector<std::size_t> methods;  ///< Which of the experiment's methods went along it.
  std::vector<bool> in_contact;      ///< One a frame (contact.h).
  /// Of the probes that the plan has, by name.
  std::map<std::string, std::unique_ptr<const ProbeFindings>, std::less<>> findings;

  /// Null where the plan leaves the probe out, and where it looks at no frame.
  const TruthFindings* truth() const { return found<TruthFindings>("truth"); }
  const FclCheck* fcl() const { return found<FclCheck>("fcl"); }

 private:
  template <typename Findings>
  const Findings* found(std::string_view probe) const {
    const auto at = findings.find(probe);
    return at == findings.end() ? nullptr : static_cast<const Findings*>(at->second.get());
  }
};

/// Everything that a run produced, in memory.
struct RunResult {
  Plan plan;
  PreparedRun prepared;
  std::vector<MethodRecord> records;   ///< In the order of the experiment's methods, like the next two.
  std::vector<RealtimeRecord> clocks;  ///< Of the driver realtime; else empty.
  std::vector<std::size_t> track_of_method;
  std::vector<Track> tracks;
  bool one_track = false;             ///< All methods see the poses of the path under one profile.
  std::vector<bool> in_contact;       ///< One a frame of the path, under the first profile's cutoff.
  std::vector<std::string> warnings;  ///< What a reader of the result must know, in plain words.
  std::int64_t resumed_frames =
      0;  ///< Whose times an interrupted run measured, over methods and repetitions.

  const Track& track_of(std::size_t method) const { return tracks[track_of_method[method]]; }
  /// Which one of its track a method is.
  std::size_t place_of(std::size_t method) const;
  /// Of a method with truth; one entry a TruthFrame. Empty where the truth probe is off.
  const std::vector<TruthComparison>& comparisons(std::size_t method) const;
  /// Group of the file that a track's datasets stand in: empty where all methods share it, else the method's.
  std::string group_of(const Track& track) const {
    return one_track ? "" : "/methods/" + records[track.methods.front()].label;
  }
};

/// A larger share of clipped frames in contact is worth a word: there a force says nothing of its LMDs.
inline constexpr double CLIPPED_SHARE = 0.1;

/// Unset where no more than CLIPPED_SHARE of the frames in contact are clipped.
std::optional<SceneWarning> clipping_warning(const MethodRecord& record, const std::vector<bool>& in_contact);

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
