// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/prepare/mover_play.h>
#include <lmdbench/realtime/record.h>
#include <lmdbench/result_file/result_writer.h>
#include <lmdbench/run/run.h>

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

/// Results of several movers have a column each: the moving mesh, then the entries of `/movers`.
namespace lmdbench {

/// A dataset of one axis.
template <typename Value>
void write_values(ResultWriter& writer, const DatasetInfo& info, const std::vector<Value>& values) {
  writer.write(info, std::span<const Value>(values), {values.size()});
}

/// /path/movers: every pose of every mover.
void write_mover_poses(ResultWriter& writer, const MoverPlay& play);

/// movers/ of a method: force and torque on each in each frame.
void write_mover_frames(ResultWriter& writer, const std::string& group, const MethodRecord& record,
                        std::size_t movers, bool torque);

/// Writes /path, /scene, /methods, /reference and /crosscheck of the result contract;
/// provenance is not part of it. Does not commit.
void write_result(ResultWriter& writer, const Experiment& experiment, const RunResult& result);

/// The group /path: time and pose of every frame; in a closed loop of the hand's intended path.
void write_path(ResultWriter& writer, const RunResult& result);

/// Attributes of a group: the profile's constants, and the limit of its sum on the device.
void write_profile(ResultWriter& writer, const std::string& group, const PreparedProfile& profile,
                   const VirtualPhantom& device);

/// The group /scene: first force profile, device, meshes and warnings.
void write_scene(ResultWriter& writer, const RunResult& result);

/// `/realtime` of the result file (results/README.md).
void write_realtime(ResultWriter& writer, const std::vector<RealtimeRecord>& clocks);

/// For people: rates, loads and lateness over the floor.
std::string realtime_text(const std::vector<RealtimeRecord>& clocks);

/// JSON: [{"label", "frames_skipped", "frames_lost", "floor_skipped", "stolen_s", "grants": [...],
/// "lateness": {SERIES: [{"share", "value_s", "low_s", "high_s"}]}, "roles": [{"name", ...}]}].
nlohmann::ordered_json realtime_json(const std::vector<RealtimeRecord>& clocks);

}  // namespace lmdbench
