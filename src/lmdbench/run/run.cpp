// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/probed_frames.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/run/deforming_distance.h>
#include <lmdbench/run/mover_probe.h>
#include <lmdbench/run/realtime_driver.h>
#include <lmdbench/run/run.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace lmdbench {
namespace {

/// What the run itself found out that a reader must know.
void note_findings(const Experiment& experiment, RunResult& result) {
  std::map<std::string, std::ptrdiff_t>
      in_contact;  // by label: notes must not depend on the order of methods
  for (const MethodRecord& record : result.records)
    in_contact[record.label] =
        std::count_if(record.frames.begin(), record.frames.end(),
                      [](const FrameRecord& frame) { return frame.contact_without_direction > 0; });
  for (const auto& [label, count] : in_contact) {
    if (count > 0)
      result.warnings.push_back(
          fmt::format("{}: touching triangles in {} of {} frames; there an LMD keeps its last direction",
                      label, count, result.prepared.times.size()));
  }
  for (const MethodRecord& record : result.records) {
    const auto count = std::ranges::count_if(
        record.frames, [](const FrameRecord& frame) { return frame.lmds_without_index > 0; });
    if (count > 0)
      result.warnings.push_back(
          fmt::format("{}: LMDs without an index in {} of {} frames (lmds_without_index); each pushes by "
                      "itself, and the force may "
                      "jump where one is born or dies",
                      record.label, count, record.frames.size()));
  }
  for (std::size_t i = 0; i < result.records.size(); ++i)
    if (const auto warning = clipping_warning(result.records[i], result.track_of(i).in_contact))
      result.warnings.push_back(to_text(*warning));
  for (const RealtimeRecord& clock : result.clocks)
    for (std::string& warning : realtime_warnings(clock)) result.warnings.push_back(std::move(warning));
  if (experiment.driver.repetitions == 1 && !experiment.realtime)
    result.warnings.emplace_back("a single repetition: its times include the warm-up");
  for (const Track& track : result.tracks) {
    if (!track.fcl) continue;
    std::map<std::string, std::int64_t> exceptions;
    for (const FclException& exception : track.fcl->exceptions) ++exceptions[exception.who];
    for (const auto& [who, count] : exceptions)
      result.warnings.push_back(
          fmt::format("{}: minimum distance differs from FCL's in {} of {} frames, listed in "
                      "{}/crosscheck/fcl/exceptions",
                      who, count, track.fcl->frames.size(),
                      result.one_track ? "" : "/methods/" + result.records[track.methods.front()].label));
  }
}

/// Which methods share poses and profile.
void make_tracks(const Experiment& experiment, RunResult& result) {
  const bool shared = !experiment.loop.closed;
  if (shared) result.tracks.resize(experiment.profiles.size());
  for (std::size_t i = 0; i < experiment.methods.size(); ++i) {
    const std::size_t profile = experiment.methods[i].profile;
    const std::size_t track = shared ? profile : i;
    if (!shared) result.tracks.emplace_back();
    result.tracks[track].profile = profile;
    result.tracks[track].methods.push_back(i);
    result.track_of_method.push_back(track);
  }
  result.one_track = shared && result.tracks.size() == 1;
}

/// The methods that promise the complete set and leave no doubt about it say what is true in every frame.
void find_complete_truth(const Experiment& experiment, RunResult& result, Track& track) {
  std::vector<ProbedRecord> candidates;
  for (const std::size_t i : track.methods) {
    const MethodDescription& method = method_description(experiment.methods[i].name);
    if (method.promise != Promise::COMPLETE_SET || method.tracks_locally) continue;
    candidates.push_back({&result.records[i], &result.comparisons[i]});
    const auto wrong = std::count_if(result.comparisons[i].begin(), result.comparisons[i].end(),
                                     [](const TruthComparison& row) { return !row.same.exact(); });
    if (wrong > 0)
      result.warnings.push_back(
          fmt::format("{}: its set is not the exhaustive one in {} of {} probed frames, so it is not taken "
                      "for the truth of the others",
                      result.records[i].label, wrong, result.comparisons[i].size()));
  }
  track.complete = complete_truth(std::move(candidates));
}

}  // namespace

RunResult run_experiment(const Experiment& experiment, const RunProgress& progress,
                         const MakeKeeper& make_keeper) {
  const auto phase = [&](const std::string& name) -> Progress {
    if (!progress) return {};
    return [&progress, name](std::int64_t done, std::int64_t total) { return progress(name, done, total); };
  };
  RunResult result{make_plan(experiment),
                   prepare(experiment, phase("path"), Deforming::FOLLOWED),
                   {},
                   {},
                   {},
                   {},
                   {},
                   false,
                   {},
                   {},
                   0};
  make_tracks(experiment, result);
  PreparedRun& prepared = result.prepared;
  result.warnings = prepared.warnings;
  const auto frame_count = static_cast<std::int64_t>(prepared.input.poses.size());
  const std::vector<LockstepMethod> methods = lockstep_methods(experiment, prepared);

  std::vector<std::int64_t> probed = truth_frames(experiment, prepared);
  if (result.plan.needs(Part::LMD_LISTS)) {
    prepared.input.keep_lmds = [](std::int64_t) { return true; };
  } else {
    const std::set<std::int64_t> kept(probed.begin(), probed.end());
    prepared.input.keep_lmds = [kept](std::int64_t frame) { return kept.count(frame) > 0; };
  }
  const std::unique_ptr<RunKeeper> keeper =
      make_keeper ? make_keeper(result, prepared.input.frames.value_or(frame_count)) : nullptr;
  const bool forecast = allowed(experiment.rules, Rule::CONTACT_FORECAST);
  const std::shared_ptr<const MoverPlay> movers = prepared.input.movers;
  const auto contact_along = [&](const Scene& scene, const std::vector<Pose>& poses) {
    return movers ? frames_in_contact(*movers, scene.cutoff)
                  : frames_in_contact(scene, prepared.input.deformation, poses, forecast);
  };
  result.in_contact = contact_along(prepared.scene(), prepared.input.poses);
  result.plan.scene = look_at(experiment, prepared, result.in_contact);
  for (const SceneWarning& warning : result.plan.scene->warnings) result.warnings.push_back(to_text(warning));
  result.plan.rules = decide_rules({experiment, prepared.input.poses, result.in_contact, probed});
  const ProbeShortcuts shortcuts{.warm = is_on(result.plan.rules, Rule::WARM_CROSSCHECK),
                                 .reuse_repeated = is_on(result.plan.rules, Rule::REPEATED_POSE)};
  if (experiment.realtime) {
    RealtimeRun run = run_realtime(methods, prepared.input,
                                   {*experiment.realtime, experiment.loop, experiment.driver.predict},
                                   phase("run"), keeper.get());
    result.records = std::move(run.records);
    result.clocks = std::move(run.clocks);
    // Frames whose sets nobody knows cannot be compared.
    std::erase_if(probed, [&](std::int64_t frame) {
      return std::any_of(result.records.begin(), result.records.end(),
                         [&](const MethodRecord& record) { return !record.lmds.contains(frame); });
    });
  } else {
    result.records = run_lockstep(methods, prepared.input, experiment.driver, phase("run"), keeper.get());
  }
  if (keeper) result.resumed_frames = keeper->resumed_frames();

  for (Track& track : result.tracks) {
    const PreparedProfile& profile = prepared.profiles[track.profile];
    LockstepInput input = prepared.input;
    input.make_poses = nullptr;
    if (experiment.loop.closed) input.poses = result.records[track.methods.front()].poses;
    track.in_contact = result.one_track ? result.in_contact : contact_along(profile.scene, input.poses);
    const std::vector<bool>* empty_elsewhere =
        is_on(result.plan.rules, Rule::TRUTH_IN_CONTACT) ? &track.in_contact : nullptr;
    if (result.plan.needs(Part::TRUTH_PROBE))
      track.truth =
          movers ? probe_mover_truth(*movers, input, profile.force, probed, phase("truth"), empty_elsewhere)
                 : probe_truth(profile.scene, input, profile.force,
                               *experiment.profiles[track.profile].aggregation, probed, phase("truth"),
                               empty_elsewhere, shortcuts.reuse_repeated);
    if (result.plan.needs(Part::INTERSECTIONS))
      track.polylines =
          probe_polylines(profile.scene, input, probed_frames(frame_count, experiment.polyline_stride_frames),
                          phase("polylines"));
    if (result.plan.needs(Part::FCL)) {
      std::vector<LockstepMethod> along;
      for (const std::size_t i : track.methods) along.push_back(methods[i]);
      const std::vector<std::int64_t> checked = probed_frames(frame_count, experiment.fcl_stride_frames);
      track.fcl = movers ? probe_mover_fcl(*movers, profile.scene.cutoff, along, checked,
                                           experiment.fcl_tolerance_relative, phase("fcl"))
                         : probe_fcl(profile.scene, input, along, checked, experiment.fcl_tolerance_relative,
                                     phase("fcl"), shortcuts);
    }
  }
  if (result.plan.needs(Part::TRUTH_PROBE)) {
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const Track& track = result.track_of(i);
      const ForceLaw law = methods[i].profile.law;
      result.comparisons.push_back(movers ? compare_with_truth(track.truth, result.records[i], law, *movers)
                                          : compare_with_truth(track.truth, result.records[i], law,
                                                               prepared.profiles[track.profile].scene));
    }
    for (Track& track : result.tracks) find_complete_truth(experiment, result, track);
  }
  note_findings(experiment, result);
  return result;
}

}  // namespace lmdbench
