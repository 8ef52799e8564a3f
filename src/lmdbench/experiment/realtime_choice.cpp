// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/experiment/realtime_choice.h>

#include <nlohmann/json.hpp>

namespace lmdbench {

RealtimeChoice realtime_choice(const nlohmann::json& entry) {
  RealtimeChoice choice;
  choice.required = entry["required"].get<bool>();
  if (entry.contains("seconds")) choice.seconds = entry["seconds"].get<double>();
  if (entry.contains("cores")) choice.cores = entry["cores"].get<std::int64_t>();
  if (entry.contains("tracking_rate_hz")) choice.tracking_rate_hz = entry["tracking_rate_hz"].get<double>();
  choice.search_rate_hz = entry["search_rate_hz"].get<double>();
  choice.pin = entry["pin"].get<bool>();
  choice.priority = entry["priority"].get<int>();
  choice.lock_memory = entry["lock_memory"].get<bool>();
  choice.floor_s = entry["floor_s"].get<double>();
  choice.queue_ticks = entry["queue_ticks"].get<std::int64_t>();
  choice.device_steps = entry["device_steps"].get<std::int64_t>();
  choice.caller = entry["servo"] == "callback" ? ServoCaller::CALLBACK : ServoCaller::CLOCK;
  choice.callback_rate_hz = entry["callback_rate_hz"].get<double>();
  const nlohmann::json& plant = entry["plant"];
  choice.plant = {plant["search_sleep_s"].get<double>(), plant["recorder_stall_s"].get<double>(),
                  plant["neighbour_busy_s"].get<double>(), plant["stopped_role"].get<std::string>(),
                  plant["stop_s"].get<double>()};
  return choice;
}

}  // namespace lmdbench
