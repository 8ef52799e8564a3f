// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/result_file/result_writer.h>
#include <lmdbench/run/realtime_record.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace lmdbench {

/// `/realtime` of the result file (results/README.md).
void write_realtime(ResultWriter& writer, const std::vector<RealtimeRecord>& clocks);

/// For people: rates, loads and lateness over the floor.
std::string realtime_text(const std::vector<RealtimeRecord>& clocks);

/// The same for programs: [{"label", "frames_skipped", "frames_lost", "floor_skipped", "stolen_s", "grants": [...], "lateness": {SERIES:
/// [{"share", "value_s", "low_s", "high_s"}]}, "roles": [{"name", "core", "rate_hz", "load", ...}]}].
nlohmann::ordered_json realtime_json(const std::vector<RealtimeRecord>& clocks);

}  // namespace lmdbench
