// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/realtime/servo_clock.h>
#include <lmdbench/realtime/thread_policy.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>

/// Caller of the servo loop: this program's grid, or a device's driver (own thread and rate).
namespace lmdbench {

/// The servo loop's body: one tick; false ends the loop. Called in one thread.
using ServoTick = std::function<bool(const Tick& tick)>;

/// Calls on this program's clock, in the calling thread.
void call_on_grid(std::int64_t start, std::int64_t period, const ServoTick& tick);

/// The interface of a haptic device's library (modelled on OpenHaptics' scheduler): it calls a
/// function from its own thread, at its own rate. A stand-in for a real one, without a device.
class DeviceScheduler {
 public:
  /// @return whether to continue
  using Callback = bool (*)(void* user_data);

  ~DeviceScheduler() { stop(); }
  void start(double rate_hz, Callback callback, void* user_data);
  /// Waits for the callback under way.
  void stop();

 private:
  std::thread thread_;
  std::atomic<bool> stopped_{false};
};

/// Lets a device's callback replace this program's clock. Its ticks are off the grid: each counts
/// for the period that has begun, so a slower device leaves periods without a tick and a faster one
/// gives some two. `asked` is one period of the device after the last call.
/// Returns when `tick` ended the loop.
/// @param begin  called first in the device's thread, to give it its policy
void call_from_device(DeviceScheduler& scheduler, double rate_hz, std::int64_t start, std::int64_t period,
                      const std::function<void()>& begin, const ServoTick& tick);

}  // namespace lmdbench
