// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/realtime/servo_clock.h>
#include <lmdbench/realtime/thread_policy.h>
#include <lmdbench/realtime/thread_use.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Realtime data beyond a run's frames. Times are nanoseconds of the monotonic clock.
namespace lmdbench {

/// One of the paper's four threads (section 5).
struct RoleRecord {
  std::string name;  ///< "servo", "tracking", "search", "scene"
  std::optional<int> core;
  TickTimes times;                ///< Its turns; of tracking one in 0.5 ms at most.
  std::vector<std::int64_t> age;  ///< By turn, at its end: of its pose; servo: of the set in use.
  std::int64_t turns = 0;         ///< All, recorded or not.
  std::int64_t lost = 0;          ///< Turns for which the recorder had no room.
  ThreadUse use;                  ///< While it ran.
  std::int64_t ran_ns = 0;        ///< Running time.

  double rate_hz() const {
    return ran_ns > 0 ? 1e9 * static_cast<double>(turns) / static_cast<double>(ran_ns) : 0.0;
  }
  /// Share of a core.
  double load() const {
    return ran_ns > 0 ? static_cast<double>(use.processor_ns) / static_cast<double>(ran_ns) : 0.0;
  }
};

/// Indices in RealtimeRecord::roles during a run. A method without local tracking has no search and
/// no tracking role, also not in its record.
enum class RoleIndex : std::uint8_t { SERVO, SEARCH, TRACKING, SCENE };

/// Source of a result's frame.
enum class FrameSource : std::uint8_t {
  TICK,     ///< A tick of the servo loop.
  SKIPPED,  ///< No tick: what the device held.
  LOST      ///< No room in the recorder: unknown, shown as held.
};

/// One method's run.
struct RealtimeRecord {
  std::string label;
  std::int64_t start = 0;   ///< Of the servo's grid.
  std::int64_t period = 0;  ///< Of the grid.
  std::vector<Grant> grants;
  std::vector<RoleRecord> roles;         ///< The servo's first.
  std::vector<std::int64_t> tick_frame;  ///< By tick of the servo.
  /// By tick: time since the pose at which the set in use was searched.
  std::vector<std::int64_t> search_age;
  std::vector<FrameSource> frame_source;  ///< By frame.
  TickTimes floor_before, floor_after;    ///< The control loop.
  std::int64_t lmd_lists_lost = 0;        ///< LMD lists without room in the recorder.
  double stolen_s = 0.0;                  ///< By the hypervisor, from the cores in use.

  const RoleRecord& servo() const { return roles.front(); }
  std::int64_t frames_from(FrameSource source) const;
};

/// Warnings about the clock for a result's reader: refusals, late ticks, losses.
std::vector<std::string> realtime_warnings(const RealtimeRecord& clock);

}  // namespace lmdbench
