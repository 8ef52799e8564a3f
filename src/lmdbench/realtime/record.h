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

/// What a run on a clock leaves beside the frames of any run. Times are nanoseconds of the monotonic clock.
namespace lmdbench {

/// One of the paper's four threads (section 5).
struct RoleRecord {
  std::string name;  ///< "servo", "tracking", "search", "scene"
  std::optional<int> core;
  TickTimes times;  ///< Its turns, one in 0.5 ms at most.
  std::vector<std::int64_t>
      age;  ///< By turn: of the pose that it worked on when it was done; for the servo of the set in use.
  std::int64_t turns = 0;   ///< All of them, listed or not.
  std::int64_t lost = 0;    ///< Turns for which the recorder had no room.
  ThreadUse use;            ///< While it ran.
  std::int64_t ran_ns = 0;  ///< How long that was.

  double rate_hz() const {
    return ran_ns > 0 ? 1e9 * static_cast<double>(turns) / static_cast<double>(ran_ns) : 0.0;
  }
  /// Share of a core.
  double load() const {
    return ran_ns > 0 ? static_cast<double>(use.processor_ns) / static_cast<double>(ran_ns) : 0.0;
  }
};

/// Places in RealtimeRecord::roles while a run goes on; a method without local tracking has no search and no tracking, and its
/// record none of them.
enum class RoleIndex : std::uint8_t { SERVO, SEARCH, TRACKING, SCENE };

/// Where a frame of the result comes from.
enum class FrameSource : std::uint8_t {
  TICK,     ///< A tick of the servo loop.
  SKIPPED,  ///< No tick came: what the device held.
  LOST      ///< The recorder had no room: unknown, shown as held.
};

/// One method's run.
struct RealtimeRecord {
  std::string label;
  std::int64_t start = 0;   ///< Of the servo's grid.
  std::int64_t period = 0;  ///< Of it.
  std::vector<Grant> grants;
  std::vector<RoleRecord> roles;         ///< The servo's first.
  std::vector<std::int64_t> tick_frame;  ///< By tick of the servo.
  std::vector<std::int64_t>
      search_age;  ///< By tick: time since the pose that the set in use was searched at.
  std::vector<FrameSource> frame_source;  ///< By frame.
  TickTimes floor_before, floor_after;    ///< The control loop.
  std::int64_t lmd_lists_lost = 0;        ///< LMD lists of frames for which the recorder had no room.
  double stolen_s = 0.0;                  ///< By the hypervisor, from the cores in use.

  const RoleRecord& servo() const { return roles.front(); }
  std::int64_t frames_from(FrameSource source) const;
};

/// What a reader of the result must know of the clock: what was refused, what came late, what was lost.
std::vector<std::string> realtime_warnings(const RealtimeRecord& clock);

}  // namespace lmdbench
