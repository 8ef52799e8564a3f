// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace lmdbench {

/// Overload on purpose, to observe a run under it.
struct PlantedOverload {
  double search_sleep_s = 0.0;    ///< Delay of every global search before its result goes on.
  double recorder_stall_s = 0.0;  ///< One stop of the scene role, at a quarter of the run.
  /// A thread of the servo's priority computes on its core this long, every 50 ms.
  double neighbour_busy_s = 0.0;
  std::string stopped_role;  ///< "tracking" or "search": stops at a quarter of the run ...
  double stop_s = 0.0;       ///< ... for this long.
};

/// Caller of the servo loop.
enum class ServoCaller : std::uint8_t {
  CLOCK,    ///< This program's own grid.
  CALLBACK  ///< A device's driver: its own thread and rate.
};

/// `/driver/realtime` of an experiment.
struct RealtimeChoice {
  bool required = false;                   ///< What the system refuses ends the run.
  std::optional<double> seconds;           ///< Duration, on the path there and back; unset: once.
  std::optional<std::int64_t> cores;       ///< At most; unset: all that the process may use.
  std::optional<double> tracking_rate_hz;  ///< 0: as fast as it can; unset: servo rate.
  double search_rate_hz = 0.0;             ///< 0: as fast as it can.
  bool pin = true;
  /// Of the servo loop under SCHED_FIFO; tracking has slightly less. 0: the normal policy.
  int priority = 80;
  bool lock_memory = true;
  double floor_s = 2.0;             ///< Of the control loop, before and after each method.
  std::int64_t queue_ticks = 4096;  ///< Between servo loop and recorder.
  std::int64_t device_steps = 10;   ///< Simulation steps a servo period: resolution of jitter.
  ServoCaller caller = ServoCaller::CLOCK;
  double callback_rate_hz = 1000.0;  ///< Of the calling device.
  PlantedOverload plant;
};

/// Reads the checked object, with the schema's defaults.
RealtimeChoice realtime_choice(const nlohmann::json& entry);

}  // namespace lmdbench
