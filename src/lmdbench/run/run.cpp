// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/statistics.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/plugin/outsider_notes.h>
#include <lmdbench/prepare/contact.h>
#include <lmdbench/realtime/driver.h>
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

/// Notes of the run itself that a reader must know.
void note_findings(const Experiment& experiment, RunResult& result) {
  std::map<std::string, std::ptrdiff_t> in_contact;  // by label: in any order of methods
  for (const MethodRecord& record : result.records)
    in_contact[record.label] =
        std::count_if(record.frames.begin(), record.frames.end(),
                      [](const FrameRecord& frame) { return frame.contact_without_direction > 0; });
  for (const auto& [label, count] : in_contact) {
    if (count > 0)
      result.warnings.push_back(
          fmt::format("{}: triangles intersect in {} of {} frames; there an LMD keeps its last direction",
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
  for (std::size_t i = 0; i < result.records.size(); ++i) {
    const PreparedProfile& profile = result.prepared.profiles[result.track_of(i).profile];
    const bool by_maximum =
        profile.force.largest_sum < result.prepared.input.device.device().maximum_force.value;
    if (const auto warning = clipping_warning(result.records[i], result.track_of(i).in_contact, by_maximum))
      result.warnings.push_back(to_text(*warning));
  }
  for (const RealtimeRecord& clock : result.clocks)
    for (std::string& warning : realtime_warnings(clock)) result.warnings.push_back(std::move(warning));
  if (experiment.driver.repetitions == 1 && !experiment.realtime)
    result.warnings.emplace_back("a single repetition: its times include the warm-up");
  for (const Track& track : result.tracks)
    for (const Probe& probe : probes())
      if (const auto found = track.findings.find(probe.name); found != track.findings.end())
        for (std::string& note : found->second->notes(result.group_of(track)))
          result.warnings.push_back(std::move(note));
}

/// Faults of methods from outside, which affect no other method.
void note_outsiders(const Experiment& experiment, RunResult& result) {
  for (std::size_t i = 0; i < result.records.size(); ++i) {
    const MethodDescription& method = method_description(experiment.methods[i].name);
    if (method.plugin.empty()) continue;
    const MethodRecord& record = result.records[i];
    WorkCounters all;
    for (const FrameRecord& frame : record.frames) all += frame.counters;
    for (std::string& note : outsider_notes(method, record.label, all))
      result.warnings.push_back(std::move(note));
    if (record.other_repetitions > 0)
      result.warnings.push_back(
          fmt::format("{}, from outside: {} of {} repetitions left another result than the first, which is "
                      "the one that is kept",
                      record.label, record.other_repetitions, record.repetitions.size()));
    const std::vector<double>& way = record.repetitions.front().way;
    if (!way.empty())
      result.warnings.push_back(fmt::format(
          "{}, from outside: {:.3g} us in the median of a frame to it, back and for judging its answer, "
          "beside its own times (way_time)",
          record.label, 1e6 * median(way)));
  }
}

/// Groups the methods that share poses and profile.
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

/// Runs the probes along a track.
/// @param input the run's, with the poses of the track
void probe(const Experiment& experiment, const std::vector<DrivenMethod>& methods, const DriverInput& input,
           RunResult& result, Track& track,
           const std::function<Progress(const std::string& phase)>& progress) {
  for (const Probe& probe : probes()) {
    if (!result.plan.needs(probe.title)) continue;
    ProbedTrack probed{.choice = experiment.probes.at(probe.name),
                       .profile = result.prepared.profiles[track.profile],
                       .input = input,
                       .in_contact = track.in_contact,
                       .aggregation = experiment.profiles[track.profile].aggregation,
                       .methods = {},
                       .choices = {},
                       .records = {},
                       .rules = result.plan.rules,
                       .frames = probed_frames(experiment, probe.name, input.poses.size()),
                       .progress = progress(probe.name)};
    for (const std::size_t i : track.methods) {
      probed.methods.push_back(methods[i]);
      probed.choices.push_back(&experiment.methods[i]);
      probed.records.push_back(&result.records[i]);
    }
    // Frames without a method's set cannot be compared: a realtime recorder may lose some.
    if (probe.reads_lmds)
      std::erase_if(probed.frames, [&](std::int64_t frame) {
        return std::ranges::any_of(result.records,
                                   [&](const MethodRecord& record) { return !record.lmds.contains(frame); });
      });
    if (auto found = probe.run(probed)) track.findings.emplace(probe.name, std::move(found));
  }
}

}  // namespace

std::optional<SceneWarning> clipping_warning(const MethodRecord& record, const std::vector<bool>& in_contact,
                                             bool by_maximum) {
  std::int64_t contact = 0, clipped = 0;
  for (std::size_t frame = 0; frame < record.frames.size(); ++frame) {
    if (!in_contact[frame]) continue;
    ++contact;
    clipped += record.frames[frame].force_clipped ? 1 : 0;
  }
  if (static_cast<double>(clipped) <= CLIPPED_SHARE * static_cast<double>(contact)) return std::nullopt;
  return SceneWarning{
      fmt::format("{}: {} clips the force in {:.0f} % of the frames in contact ({} of {}), which hides what "
                  "the method found",
                  record.label, by_maximum ? "maximum_force_n" : "the device",
                  100.0 * static_cast<double>(clipped) / static_cast<double>(contact), clipped, contact),
      by_maximum ? "set /force/clip to device: the sum is clipped at the force of one contact"
                 : "lower /force/maximum_force_n, or take the device \"ideal\""};
}

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
                   false,
                   {},
                   {},
                   0};
  make_tracks(experiment, result);
  PreparedRun& prepared = result.prepared;
  result.warnings = prepared.warnings;
  const auto frame_count = static_cast<std::int64_t>(prepared.input.poses.size());
  const std::vector<DrivenMethod> methods = driven_methods(experiment, prepared);

  std::set<std::int64_t> kept;
  for (const Probe& probe : probes())
    if (probe.reads_lmds)
      for (const std::int64_t frame : probed_frames(experiment, probe.name, prepared.input.poses.size()))
        kept.insert(frame);
  prepared.input.keep_lmds = [kept, all = result.plan.needs(Part::LMD_LISTS)](std::int64_t frame) {
    return all || kept.contains(frame);
  };
  const std::unique_ptr<RunKeeper> keeper =
      make_keeper ? make_keeper(result, prepared.input.frames.value_or(frame_count)) : nullptr;
  const bool forecast = allowed(experiment.rules, Rule::CONTACT_FORECAST);
  const auto contact_along = [&](const Scene& scene, const std::vector<Pose>& poses) {
    return frames_in_contact(scene, prepared.input.motion, poses, forecast);
  };
  result.in_contact = contact_along(prepared.scene(), prepared.input.poses);
  result.plan.scene = look_at(experiment, prepared, result.in_contact);
  for (const SceneWarning& warning : result.plan.scene->warnings) result.warnings.push_back(to_text(warning));
  result.plan.rules = decide_rules({experiment, prepared.input.poses, result.in_contact});
  if (experiment.realtime) {
    RealtimeRun run = run_realtime(methods, prepared.input, {*experiment.realtime, experiment.driver.predict},
                                   phase("run"), keeper.get());
    result.records = std::move(run.records);
    result.clocks = std::move(run.clocks);
  } else {
    result.records = run_lockstep(methods, prepared.input, experiment.driver, phase("run"), keeper.get());
  }
  if (keeper) result.resumed_frames = keeper->resumed_frames();

  for (Track& track : result.tracks) {
    const PreparedProfile& profile = prepared.profiles[track.profile];
    DriverInput input = prepared.input;
    if (experiment.loop.closed) input.poses = result.records[track.methods.front()].poses;
    track.in_contact = result.one_track ? result.in_contact : contact_along(profile.scene, input.poses);
    probe(experiment, methods, input, result, track, phase);
  }
  note_findings(experiment, result);
  note_outsiders(experiment, result);
  return result;
}

std::size_t RunResult::place_of(std::size_t method) const {
  const std::vector<std::size_t>& methods = track_of(method).methods;
  return static_cast<std::size_t>(std::ranges::find(methods, method) - methods.begin());
}

const std::vector<TruthComparison>& RunResult::comparisons(std::size_t method) const {
  static const std::vector<TruthComparison> none;
  const TruthFindings* truth = track_of(method).truth();
  return truth == nullptr ? none : truth->comparisons[place_of(method)];
}

}  // namespace lmdbench
