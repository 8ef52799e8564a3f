// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/realtime/servo_clock.h>
#include <lmdbench/realtime/thread_policy.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

/// Who calls the servo loop: the bench's own grid, or the driver of a device with a thread and a rate of its own.
namespace lmdbench {

/// The servo loop's body: one tick; false ends the loop. Called in one thread.
using ServoTick = std::function<bool(const Tick& tick)>;

/// The bench's clock, in the calling thread.
void call_on_grid(std::int64_t start, std::int64_t period, const ServoTick& tick);

/// What a haptic device's library offers (OpenHaptics' scheduler is the model): it calls a function from a thread that it
/// owns, at a rate that it keeps. This one is a stand-in without a device, which shows where a real one goes.
class DeviceScheduler {
 public:
  /// @return whether to go on
  using Callback = bool (*)(void* user_data);

  ~DeviceScheduler() { stop(); }
  void start(double rate_hz, Callback callback, void* user_data);
  /// Waits for the callback under way.
  void stop();

 private:
  std::thread thread_;
  std::atomic<bool> stopped_{false};
};

/// Puts a device's callback in the place of the bench's clock. The device's ticks have no place on the bench's grid: each
/// is for the period that has begun, so that a slower device leaves periods without a tick and a faster one gives some two.
/// `asked` is one period of the device after the last call.
/// Returns when `tick` ended the loop.
/// @param begin  called first in the device's thread, to give it its policy
void call_from_device(DeviceScheduler& scheduler, double rate_hz, std::int64_t start, std::int64_t period,
                      const std::function<void()>& begin, const ServoTick& tick);

}  // namespace lmdbench
