// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace lmdbench {

/// Overload on purpose, to see what a run does under it.
struct PlantedOverload {
  double search_sleep_s = 0.0;    ///< Every global search sleeps this long before its result goes on.
  double recorder_stall_s = 0.0;  ///< The scene role stands still this long, once, at a quarter of the run.
  double neighbour_busy_s =
      0.0;  ///< A thread of the servo's priority on its core computes this long, every 50 ms.
  std::string stopped_role;  ///< "tracking" or "search": stands still from a quarter of the run on ...
  double stop_s = 0.0;       ///< ... for this long.
};

/// Who calls the servo loop.
enum class ServoCaller : std::uint8_t {
  CLOCK,    ///< The bench's own grid.
  CALLBACK  ///< A device's driver, from a thread and at a rate of its own.
};

/// `/driver/realtime` of an experiment.
struct RealtimeChoice {
  bool required = false;                   ///< What the system refuses ends the run.
  std::optional<double> seconds;           ///< The path there and back until then; unset: the path once.
  std::optional<std::int64_t> cores;       ///< Most that are used; unset: all that the process may use.
  std::optional<double> tracking_rate_hz;  ///< 0: as fast as it can; unset: the servo's.
  double search_rate_hz = 0.0;             ///< 0: as fast as it can.
  bool pin = true;
  int priority =
      80;  ///< Of the servo loop under SCHED_FIFO; tracking has a little less. 0: the normal policy.
  bool lock_memory = true;
  double floor_s = 2.0;             ///< Of the control loop, before and after each method.
  std::int64_t queue_ticks = 4096;  ///< Between servo loop and recorder.
  std::int64_t device_steps = 10;  ///< Of the simulated device in a servo period: how finely jitter moves it.
  ServoCaller caller = ServoCaller::CLOCK;
  double callback_rate_hz = 1000.0;  ///< Of the device that calls.
  PlantedOverload plant;
};

/// Reads the checked object, with the schema's defaults.
RealtimeChoice realtime_choice(const nlohmann::json& entry);

}  // namespace lmdbench
