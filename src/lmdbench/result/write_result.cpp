// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/drivers/columns.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/metrics/summary.h>
#include <lmdbench/result/write_result.h>
#include <lmdbench/result_file/write_column.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace lmdbench {
namespace {

void write_vectors(ResultWriter& writer, const DatasetInfo& info, const std::vector<double>& values,
                   std::size_t movers) {
  writer.write(info, std::span<const double>(values), {values.size() / (3 * movers), movers, 3});
}

}  // namespace

void write_mover_poses(ResultWriter& writer, const MoverPlay& play) {
  const std::size_t movers = play.count(), frames = play.poses.size();
  std::vector<double> positions(3 * movers * frames), orientations(4 * movers * frames);
  for (std::size_t frame = 0; frame < frames; ++frame)
    for (std::size_t i = 0; i < movers; ++i) {
      const std::size_t row = frame * movers + play.number[i];
      const Pose& pose = play.poses[frame][i];
      std::copy_n(pose.translation.data(), 3, positions.begin() + static_cast<std::ptrdiff_t>(3 * row));
      std::copy_n(pose.rotation.coeffs().data(), 4,
                  orientations.begin() + static_cast<std::ptrdiff_t>(4 * row));
    }
  write_vectors(writer, {"/path/movers/position", "m", "origin of each mover's frame, world frame"},
                positions, movers);
  writer.write({"/path/movers/orientation", "1", "unit quaternion x, y, z, w of each mover"},
               std::span<const double>(orientations), {frames, movers, 4});
}

void write_mover_frames(ResultWriter& writer, const std::string& group, const MethodRecord& record,
                        std::size_t movers, bool torque) {
  const std::size_t frames = record.movers.size() / movers;
  const auto vectors = [&](const char* name, const char* units, const char* long_name,
                           Vec3 MoverFrame::*value) {
    std::vector<double> values;
    for (const MoverFrame& mover : record.movers)
      values.insert(values.end(), (mover.*value).begin(), (mover.*value).end());
    write_vectors(writer, {group + "/movers/" + name, units, long_name}, values, movers);
  };
  vectors("force", "N", "rendered force on each mover, world frame", &MoverFrame::force);
  if (torque)
    vectors("torque", "N m", "torque about each mover's centre, before the device clips it",
            &MoverFrame::torque);
  std::vector<std::uint8_t> clipped;
  std::vector<std::int64_t> counts;
  std::vector<double> distances;
  for (const MoverFrame& mover : record.movers) {
    clipped.push_back(mover.force_clipped ? 1 : 0);
    counts.push_back(mover.lmd_count);
    distances.push_back(mover.minimum_distance);
  }
  writer.write({group + "/movers/force_clipped", "1", "1 where the device clipped the mover's force"},
               std::span<const std::uint8_t>(clipped), {frames, movers});
  writer.write({group + "/movers/lmd_count", "1", "LMDs of the mover's pairs within the cutoff"},
               std::span<const std::int64_t>(counts), {frames, movers});
  writer.write({group + "/movers/minimum_distance", "m", "smallest LMD distance of the mover's pairs"},
               std::span<const double>(distances), {frames, movers});
}

namespace {

/// The columns of a record table, as far as the experiment keeps them.
template <typename Row>
void write_columns(ResultWriter& writer, const std::string& group, const std::vector<Column<Row>>& columns,
                   const std::vector<Row>& rows, const Experiment& experiment) {
  for (const Column<Row>& column : columns) {
    const bool kept = is_counter(column.name) ? experiment.record_counters : experiment.record_frames;
    if (!kept) continue;
    std::visit(
        [&](const auto& value) {
          write_column(writer, {group + "/" + column.name, column.units, column.long_name}, rows, value);
        },
        column.value);
  }
}

/// Times of all repetitions as a (repetition, column) array.
void write_times(ResultWriter& writer, const DatasetInfo& info,
                 const std::vector<RepetitionTimes>& repetitions,
                 std::vector<double> RepetitionTimes::*times) {
  std::vector<double> values;
  for (const RepetitionTimes& repetition : repetitions)
    values.insert(values.end(), (repetition.*times).begin(), (repetition.*times).end());
  writer.write(info, std::span<const double>(values),
               {repetitions.size(), (repetitions.front().*times).size()});
}

void write_frames(ResultWriter& writer, const std::string& group, const MethodChoice& choice,
                  const MethodRecord& record, const Experiment& experiment) {
  const MethodDescription method = described(experiment, choice.name);
  write_columns(writer, group, frame_columns(method, experiment.record_torque, choice.counts_indices()),
                record.frames, experiment);
  if (experiment.record_timings)
    write_times(writer, {group + "/local_update_time", "s", "time of the frame's local part, by repetition"},
                record.repetitions, &RepetitionTimes::local_update);
  if (experiment.record_timings && experiment.deforms())
    write_times(writer, following_time_info(group + "/"), record.repetitions, &RepetitionTimes::following);
  if (experiment.record_timings && !record.repetitions.front().way.empty())
    write_times(writer,
                {group + "/way_time", "s",
                 "time to the method from outside and back and to judge its answer, beside "
                 "local_update_time, by repetition"},
                record.repetitions, &RepetitionTimes::way);
}

/// For methods that search at a rate of their own.
void write_searches(ResultWriter& writer, const std::string& group, const MethodDescription& method,
                    const MethodRecord& record, const Experiment& experiment) {
  write_columns(writer, group, search_columns(method), record.searches, experiment);
  if (!experiment.record_timings) return;
  for (const SearchTime& time : search_times(method))
    write_times(writer, {group + "/" + time.name, "s", time.long_name}, record.repetitions, time.times);
}

/// @param play of several movers; else null
void write_lmd_lists(ResultWriter& writer, const std::string& group, const MethodRecord& record,
                     const Scene& scene, const MoverPlay* play) {
  std::vector<std::int64_t> offsets{0}, moving_bodies;
  LmdSet rows;
  for (std::int64_t frame = 0; frame < static_cast<std::int64_t>(record.frames.size()); ++frame) {
    // A realtime run may have lost the list: `lmd_count` says how many LMDs the frame had.
    if (const auto found = record.lmds.find(frame); found != record.lmds.end())
      rows.insert(rows.end(), found->second.begin(), found->second.end());
    offsets.push_back(static_cast<std::int64_t>(rows.size()));
  }
  if (play != nullptr) {
    for (Lmd& lmd : rows) {
      const FiledLmd filed = as_filed(lmd, scene, play);
      lmd = filed.lmd;
      moving_bodies.push_back(filed.moving_body);
    }
    write_values(writer, {group + "/moving_body", "1", "which of the movers; 0: the moving mesh"},
                 moving_bodies);
  }
  write_values(writer,
               {group + "/frame_offset", "1",
                "frame f owns rows frame_offset[f] to frame_offset[f + 1] - 1; none where its list was lost"},
               offsets);
  const auto column = [&](const std::string& name, const std::string& units, const std::string& long_name,
                          auto project) {
    write_column(writer, {group + "/" + name, units, long_name}, rows, project);
  };
  column("distance", "m", "distance of the pair", [](const Lmd& l) { return l.distance; });
  column("point_moving", "m", "point on the moving mesh, world frame",
         [](const Lmd& l) { return l.point_moving; });
  column("point_fixed", "m", "point on the fixed mesh, world frame",
         [](const Lmd& l) { return l.point_fixed; });
  column("direction", "1", "unit vector from moving to fixed", [](const Lmd& l) { return l.direction; });
  column("feature_moving_kind", "1", "0 vertex, 1 edge, 2 face",
         [](const Lmd& l) { return static_cast<std::int64_t>(l.feature_moving.kind); });
  column("feature_moving_index", "1", "index of the feature in its mesh",
         [](const Lmd& l) { return static_cast<std::int64_t>(l.feature_moving.index); });
  column("feature_fixed_kind", "1", "0 vertex, 1 edge, 2 face",
         [](const Lmd& l) { return static_cast<std::int64_t>(l.feature_fixed.kind); });
  column("feature_fixed_index", "1", "index of the feature in its mesh",
         [](const Lmd& l) { return static_cast<std::int64_t>(l.feature_fixed.index); });
  column("fixed_body", "1",
         play != nullptr ? "which of the fixed meshes, from their number on which of the movers"
                         : "which of the fixed meshes",
         [](const Lmd& l) { return std::int64_t{l.fixed_body}; });
}

void write_poses(ResultWriter& writer, const std::string& group, const std::vector<Pose>& poses) {
  write_column(writer, {group + "/position", "m", "origin of the moving mesh's frame, world frame"}, poses,
               [](const Pose& p) { return p.translation; });
  write_column(writer, {group + "/orientation", "1", "unit quaternion x, y, z, w of the moving mesh"}, poses,
               [](const Pose& p) { return p.rotation; });
}

void write_in_contact(ResultWriter& writer, const std::string& group, const std::vector<bool>& in_contact) {
  write_values(writer, {group + "/in_contact", "1", "1 where the meshes are within the cutoff of each other"},
               std::vector<std::uint8_t>(in_contact.begin(), in_contact.end()));
}

/// Findings of the probes along a track.
/// @param group of the file: `RunResult::group_of`
void write_findings(ResultWriter& writer, const std::string& group, const Experiment& experiment,
                    const Track& track) {
  for (const Probe& probe : probes()) {
    const auto found = track.findings.find(probe.name);
    if (found == track.findings.end()) continue;
    for (const ProbeDataset& dataset : probe.datasets)
      if (dataset.path.starts_with('/'))
        dataset.write(writer, {group + dataset.path, dataset.units, dataset.long_name}, *found->second, 0);
    if (probe.attributes.empty()) continue;
    for (const auto& option : probe.options.items())
      writer.attribute(group + probe.attributes, option.key(),
                       experiment.probes.at(probe.name).options[option.key()].get<double>());
  }
}

/// Findings of the probes about one of the track's methods.
void write_findings_of_method(ResultWriter& writer, const std::string& group, const RunResult& result,
                              std::size_t method) {
  const Track& track = result.track_of(method);
  for (const Probe& probe : probes())
    if (const auto found = track.findings.find(probe.name); found != track.findings.end())
      for (const ProbeDataset& dataset : probe.datasets)
        if (!dataset.path.starts_with('/'))
          dataset.write(writer, {group + "/" + dataset.path, dataset.units, dataset.long_name},
                        *found->second, result.place_of(method));
}

void write_method(ResultWriter& writer, const Experiment& experiment, const RunResult& result,
                  std::size_t index) {
  const MethodChoice& choice = experiment.methods[index];
  const MethodRecord& record = result.records[index];
  const std::string group = "/methods/" + choice.label;
  const MethodDescription method = described(experiment, choice.name);
  writer.attribute(group, "method", choice.name);
  writer.attribute(group, "method_order", static_cast<std::int64_t>(method_order(choice.name)));
  writer.attribute(group, "about", method.summary);
  writer.attribute(group, "promise", std::string(to_string(method.promise)));
  if (!method.plugin.empty()) writer.attribute(group, "plugin", method.plugin.string());
  writer.attribute(group, "tracks_locally", std::int64_t{method.tracks_locally});
  writer.attribute(group, "trackings_after_search", std::int64_t{method.trackings_after_search});
  writer.attribute(group, "force_law", std::string(to_string(choice.force_law)));
  writer.attribute(group, "aggregation", std::string(choice.aggregation->name));
  writer.attribute(group, "options", choice.options_json);
  writer.attribute(group, "result_hash", fmt::format("{:016x}", record.result_hash));
  const Track& track = result.track_of(index);
  const PreparedProfile& profile = result.prepared.profiles[track.profile];
  writer.attribute(group, "profile", profile.name);
  write_profile(writer, group, profile, result.prepared.input.device);
  const MoverPlay* movers = result.prepared.input.motion.movers.get();
  write_frames(writer, group, choice, record, experiment);
  if (!record.movers.empty() && experiment.record_frames)
    write_mover_frames(writer, group, record, movers->count(), experiment.record_torque);
  if (method.tracks_locally) write_searches(writer, group, method, record, experiment);
  write_findings_of_method(writer, group, result, index);
  if (experiment.loop.closed) {
    write_poses(writer, group + "/path", record.poses);
    write_columns(writer, group + "/loop", loop_columns(experiment.loop.rotation.has_value()), record.loop,
                  experiment);
  }
  if (!result.one_track) {
    write_in_contact(writer, experiment.loop.closed ? group + "/loop" : group, track.in_contact);
    write_findings(writer, group, experiment, track);
  }
  if (experiment.record_lmds) write_lmd_lists(writer, group + "/lmds", record, profile.scene, movers);
}

}  // namespace

void write_path(ResultWriter& writer, const RunResult& result) {
  const PreparedRun& prepared = result.prepared;
  write_values(writer, {"/path/time", "s", "time of the haptic frame"}, prepared.times);
  write_poses(writer, "/path", prepared.input.poses);
  if (prepared.input.motion.movers) write_mover_poses(writer, *prepared.input.motion.movers);
}

void write_result(ResultWriter& writer, const Experiment& experiment, const RunResult& result) {
  write_path(writer, result);
  write_scene(writer, result);
  write_in_contact(writer, "/scene", result.in_contact);
  // A single repetition counts though it is the warm-up, with a warning.
  writer.attribute("/methods", "warm_up_repetitions",
                   std::int64_t{experiment.driver.repetitions > 1 ? 1 : 0});
  writer.attribute("/methods", "driver", std::string(experiment.realtime ? "realtime" : "lockstep"));
  if (!experiment.realtime) {
    writer.attribute("/methods", "search_every_frames", experiment.driver.search_every_frames);
    writer.attribute("/methods", "search_latency_frames", experiment.driver.search_latency_frames);
  }
  for (std::size_t i = 0; i < experiment.methods.size(); ++i) write_method(writer, experiment, result, i);
  if (result.one_track) write_findings(writer, "", experiment, result.tracks.front());
  write_realtime(writer, result.clocks);
  write_summary(writer, summarise(experiment, result));
}

}  // namespace lmdbench
