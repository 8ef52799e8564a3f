// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/force/aggregation.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/metrics/summary.h>
#include <lmdbench/result/write_movers.h>
#include <lmdbench/result/write_polylines.h>
#include <lmdbench/result/write_realtime.h>
#include <lmdbench/result/write_result.h>
#include <lmdbench/run/columns.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace lmdbench {
namespace {

/// One column of a table of records; `project` gives a number or a Vec3 of a row.
template <typename Row, typename Project>
void write_column(ResultWriter& writer, const DatasetInfo& info, const std::vector<Row>& rows,
                  Project project) {
  using Value = std::decay_t<decltype(project(rows.front()))>;
  if constexpr (std::is_same_v<Value, Vec3>) {
    std::vector<double> values;
    values.reserve(rows.size() * 3);
    for (const Row& row : rows) {
      const Vec3 value = project(row);
      values.insert(values.end(), value.data(), value.data() + 3);
    }
    writer.write(info, std::span<const double>(values), {rows.size(), 3});
  } else {
    using Stored =
        std::conditional_t<std::is_floating_point_v<Value>, double,
                           std::conditional_t<std::is_same_v<Value, bool>, std::uint8_t, std::int64_t>>;
    std::vector<Stored> values;
    values.reserve(rows.size());
    for (const Row& row : rows) values.push_back(static_cast<Stored>(project(row)));
    writer.write(info, std::span<const Stored>(values), {rows.size()});
  }
}

/// The columns of a table of records that the experiment keeps.
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
}

/// What only a method with a search of its own rate has.
void write_searches(ResultWriter& writer, const std::string& group, const MethodDescription& method,
                    const MethodRecord& record, const Experiment& experiment) {
  write_columns(writer, group, search_columns(method), record.searches, experiment);
  if (!experiment.record_timings) return;
  for (const SearchTime& time : search_times(method))
    write_times(writer, {group + "/" + time.name, "s", time.long_name}, record.repetitions, time.times);
}

void write_truth(ResultWriter& writer, const std::string& group, const std::vector<TruthFrame>& truth,
                 const std::vector<TruthComparison>& rows) {
  const auto column = [&](const std::string& name, const std::string& units, const std::string& long_name,
                          auto project) {
    write_column(writer, {group + "/" + name, units, long_name}, rows, project);
  };
  using Row = const TruthComparison&;
  write_column(writer, {group + "/frame", "1", "frame that was compared with truth"}, truth,
               [](const TruthFrame& t) { return t.frame; });
  column("recall", "1", "share of true LMDs found, same features", [](Row r) { return r.same.recall(); });
  column("precision", "1", "share of LMDs that are true, same features",
         [](Row r) { return r.same.precision(); });
  column("recall_adjacent", "1", "share of true LMDs found, adjacent features",
         [](Row r) { return r.neighbours.recall(); });
  column("precision_adjacent", "1", "share of LMDs that are true, adjacent features",
         [](Row r) { return r.neighbours.precision(); });
  column("minimum_distance_error", "m", "minimum distance minus the true one",
         [](Row r) { return r.minimum_distance_error; });
  column(
      "force_error", "N",
      "length of the difference to the true rendered force under the same law and the profile's aggregation",
      [](Row r) { return r.force_error; });
  column("force_angle_error", "rad", "angle to the true force", [](Row r) { return r.force_angle_error; });
  column("force_jump", "N", "change of the method's force to the next frame",
         [](Row r) { return r.force_jump; });
}

/// @param play of several movers; else null
void write_lmd_lists(ResultWriter& writer, const std::string& group, const MethodRecord& record,
                     const MoverPlay* play) {
  std::vector<std::int64_t> offsets{0}, moving_bodies;
  LmdSet rows;
  for (std::int64_t frame = 0; frame < static_cast<std::int64_t>(record.frames.size()); ++frame) {
    const LmdSet& lmds = record.lmds.at(frame);
    rows.insert(rows.end(), lmds.begin(), lmds.end());
    offsets.push_back(static_cast<std::int64_t>(rows.size()));
  }
  if (play != nullptr) {
    for (Lmd& lmd : rows) {
      const FiledLmd filed = as_filed(lmd, *play);
      lmd = filed.lmd;
      moving_bodies.push_back(filed.moving_body);
    }
    writer.write({group + "/moving_body", "1", "which of the movers; 0: the moving mesh"},
                 std::span<const std::int64_t>(moving_bodies), {moving_bodies.size()});
  }
  writer.write({group + "/frame_offset", "1", "frame f owns rows frame_offset[f] to frame_offset[f + 1] - 1"},
               std::span<const std::int64_t>(offsets), {offsets.size()});
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

void write_reference(ResultWriter& writer, const std::string& group, const std::vector<TruthFrame>& truth) {
  const auto column = [&](const std::string& name, const std::string& units, const std::string& long_name,
                          auto project) {
    write_column(writer, {group + "/" + name, units, long_name}, truth, project);
  };
  constexpr auto LINEAR = static_cast<std::size_t>(ForceLaw::LINEAR);
  constexpr auto EXPONENTIAL = static_cast<std::size_t>(ForceLaw::EXPONENTIAL);
  column("frame", "1", "frame of the exhaustive set", [](const TruthFrame& t) { return t.frame; });
  column("lmd_count", "1", "true LMDs within the cutoff",
         [](const TruthFrame& t) { return static_cast<std::int64_t>(t.lmds.size()); });
  column("minimum_distance", "m", "smallest true LMD distance",
         [](const TruthFrame& t) { return minimum_distance(t.lmds); });
  column("force_linear", "N", "rendered force of the true set, linear law",
         [](const TruthFrame& t) { return t.force[LINEAR]; });
  column("force_exponential", "N", "rendered force of the true set, exponential law",
         [](const TruthFrame& t) { return t.force[EXPONENTIAL]; });
  column("force_jump_linear", "N", "change of the true force to the next frame, linear law",
         [](const TruthFrame& t) { return t.force_jump[LINEAR]; });
  column("force_jump_exponential", "N", "change of the true force to the next frame, exponential law",
         [](const TruthFrame& t) { return t.force_jump[EXPONENTIAL]; });
}

void write_poses(ResultWriter& writer, const std::string& group, const std::vector<Pose>& poses) {
  write_column(writer, {group + "/position", "m", "origin of the moving mesh's frame, world frame"}, poses,
               [](const Pose& p) { return p.translation; });
  std::vector<double> orientations;
  for (const Pose& pose : poses) {
    const auto& q = pose.rotation.coeffs();  // x, y, z, w
    orientations.insert(orientations.end(), q.data(), q.data() + 4);
  }
  writer.write({group + "/orientation", "1", "unit quaternion x, y, z, w of the moving mesh"},
               std::span<const double>(orientations), {poses.size(), 4});
}

void write_in_contact(ResultWriter& writer, const std::string& group, const std::vector<bool>& in_contact) {
  const std::vector<std::uint8_t> flags(in_contact.begin(), in_contact.end());
  writer.write({group + "/in_contact", "1", "1 where the meshes are within the cutoff of each other"},
               std::span<const std::uint8_t>(flags), {flags.size()});
}

/// Exceptions of several movers as files name their bodies.
/// @param moving_bodies receives the mover of each
std::vector<FclException> filed_exceptions(const FclCheck& check, const MoverPlay& play,
                                           std::vector<std::int64_t>& moving_bodies) {
  std::vector<FclException> exceptions = check.exceptions;
  for (FclException& exception : exceptions) {
    Lmd pair;
    pair.fixed_body = exception.fixed_body;
    pair.triangle_moving = exception.triangle_moving;
    pair.triangle_fixed = exception.triangle_fixed;
    const FiledLmd filed = as_filed(pair, play);
    exception.fixed_body = filed.lmd.fixed_body;
    exception.triangle_moving = filed.lmd.triangle_moving;
    exception.triangle_fixed = filed.lmd.triangle_fixed;
    moving_bodies.push_back(filed.moving_body);
    const auto mover = std::ranges::find(play.number, static_cast<std::size_t>(filed.moving_body));
    exception.pose = play.poses[static_cast<std::size_t>(exception.frame)]
                               [static_cast<std::size_t>(mover - play.number.begin())];
  }
  return exceptions;
}

/// @param play of several movers; else null
void write_fcl(ResultWriter& writer, const std::string& group, const FclCheck& check, double tolerance,
               const MoverPlay* play) {
  writer.attribute(group, "tolerance_relative", tolerance);
  const auto column = [&](const std::string& name, const std::string& units, const std::string& long_name,
                          auto project) {
    write_column(writer, {group + "/" + name, units, long_name}, check.frames, project);
  };
  column("frame", "1", "frame that was cross-checked", [](const FclFrame& f) { return f.frame; });
  column("distance", "m", "FCL's minimum distance", [](const FclFrame& f) { return f.distance; });
  column("lmdbench_distance", "m", "exact minimum distance",
         [](const FclFrame& f) { return f.lmdbench_distance; });
  column("relative_difference", "1", "difference of the two, relative to the exact one",
         [](const FclFrame& f) { return f.relative_difference; });
  column("separated", "1", "1 where FCL finds no contact", [](const FclFrame& f) { return f.separated; });
  column("agrees", "1", "1 where the two agree", [](const FclFrame& f) { return f.agrees; });

  const std::string exceptions = group + "/exceptions";
  std::vector<std::int64_t> moving_bodies;
  const std::vector<FclException> filed =
      play != nullptr ? filed_exceptions(check, *play, moving_bodies) : check.exceptions;
  if (play != nullptr)
    writer.write({exceptions + "/moving_body", "1", "mover of FCL's nearest pair"},
                 std::span<const std::int64_t>(moving_bodies), {moving_bodies.size()});
  const auto exception = [&](const std::string& name, const std::string& units, const std::string& long_name,
                             auto project) {
    write_column(writer, {exceptions + "/" + name, units, long_name}, filed, project);
  };
  std::vector<std::string> who;
  std::vector<Pose> poses;
  for (const FclException& entry : filed) {
    who.push_back(entry.who);
    poses.push_back(entry.pose);
  }
  writer.write({exceptions + "/who", "1", "label of the method, or lmdbench for the exact nearest pair"},
               who);
  write_poses(writer, exceptions, poses);
  using Row = const FclException&;
  exception("frame", "1", "frame out of tolerance", [](Row e) { return e.frame; });
  exception("distance", "m", "their minimum distance", [](Row e) { return e.distance; });
  exception("fcl_distance", "m", "FCL's minimum distance", [](Row e) { return e.fcl_distance; });
  exception("lmdbench_distance", "m", "exact minimum distance", [](Row e) { return e.lmdbench_distance; });
  exception("triangle_moving", "1", "triangle of FCL's nearest pair",
            [](Row e) { return e.triangle_moving; });
  exception("triangle_fixed", "1", "triangle of FCL's nearest pair", [](Row e) { return e.triangle_fixed; });
  exception("fixed_body", "1", "fixed mesh of FCL's nearest pair", [](Row e) { return e.fixed_body; });
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
  const MoverPlay* movers = result.prepared.input.movers.get();
  write_frames(writer, group, choice, record, experiment);
  if (movers != nullptr && experiment.record_frames)
    write_mover_frames(writer, group, record, movers->count(), experiment.record_torque);
  if (method.tracks_locally) write_searches(writer, group, method, record, experiment);
  if (!track.truth.empty()) write_truth(writer, group + "/truth", track.truth, result.comparisons[index]);
  if (experiment.loop.closed) {
    write_poses(writer, group + "/path", record.poses);
    write_columns(writer, group + "/loop", loop_columns(experiment.loop.rotation.has_value()), record.loop,
                  experiment);
  }
  if (!result.one_track) {
    write_in_contact(writer, experiment.loop.closed ? group + "/loop" : group, track.in_contact);
    if (!track.truth.empty()) write_reference(writer, group + "/reference", track.truth);
    if (!track.truth.empty() && movers != nullptr)
      write_mover_truth(writer, group + "/reference", track.truth, movers->count());
    if (track.fcl)
      write_fcl(writer, group + "/crosscheck/fcl", *track.fcl, experiment.fcl_tolerance_relative, movers);
    if (experiment.polyline_stride_frames > 0) write_polylines(writer, group + "/polylines", track.polylines);
  }
  if (experiment.record_lmds) write_lmd_lists(writer, group + "/lmds", record, movers);
  if (track.fcl) {
    const auto column = static_cast<std::size_t>(
        std::find(track.methods.begin(), track.methods.end(), index) - track.methods.begin());
    write_column(writer, {group + "/fcl/frame", "1", "frame that was compared with FCL"}, track.fcl->frames,
                 [](const FclFrame& f) { return f.frame; });
    write_column(
        writer,
        {group + "/fcl/minimum_distance_difference_relative", "1",
         "a fresh search's minimum distance minus FCL's, divided by FCL's; infinite where it found no pair"},
        track.fcl->frames, [&](const FclFrame& f) { return f.method_difference[column]; });
  }
}

}  // namespace

void write_path(ResultWriter& writer, const RunResult& result) {
  const PreparedRun& prepared = result.prepared;
  writer.write({"/path/time", "s", "time of the haptic frame"}, std::span<const double>(prepared.times),
               {prepared.times.size()});
  write_poses(writer, "/path", prepared.input.poses);
  if (prepared.input.movers) write_mover_poses(writer, *prepared.input.movers);
}

void write_result(ResultWriter& writer, const Experiment& experiment, const RunResult& result) {
  write_path(writer, result);
  write_scene(writer, result);
  write_in_contact(writer, "/scene", result.in_contact);
  // With a single repetition nothing would be left after the warm-up, so it then counts, with a warning.
  writer.attribute("/methods", "warm_up_repetitions",
                   std::int64_t{experiment.driver.repetitions > 1 ? 1 : 0});
  writer.attribute("/methods", "driver", std::string(experiment.realtime ? "realtime" : "lockstep"));
  if (!experiment.realtime) {
    writer.attribute("/methods", "search_every_frames", experiment.driver.search_every_frames);
    writer.attribute("/methods", "search_latency_frames", experiment.driver.search_latency_frames);
  }
  for (std::size_t i = 0; i < experiment.methods.size(); ++i) write_method(writer, experiment, result, i);
  if (result.one_track) {
    const Track& track = result.tracks.front();
    const MoverPlay* movers = result.prepared.input.movers.get();
    if (!track.truth.empty()) write_reference(writer, "/reference", track.truth);
    if (!track.truth.empty() && movers != nullptr)
      write_mover_truth(writer, "/reference", track.truth, movers->count());
    if (track.fcl)
      write_fcl(writer, "/crosscheck/fcl", *track.fcl, experiment.fcl_tolerance_relative, movers);
    if (experiment.polyline_stride_frames > 0) write_polylines(writer, "/polylines", track.polylines);
  }
  write_realtime(writer, result.clocks);
  write_summary(writer, summarise(experiment, result));
}

}  // namespace lmdbench
