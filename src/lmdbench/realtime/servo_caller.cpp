// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/servo_caller.h>

#include <algorithm>
#include <exception>

namespace lmdbench {
namespace {

/// Data of the device's callback.
struct DeviceCalls {
  std::int64_t start, period, device_period;
  const std::function<void()>& begin;
  const ServoTick& tick;
  std::int64_t last_call = -1, last_period = -1;
  std::atomic<bool> ended{false};
  std::exception_ptr error = nullptr;  ///< Exceptions must not enter a device's library.

  bool call() noexcept {
    try {
      if (call_tick()) return true;
    } catch (...) {
      error = std::current_exception();
    }
    ended = true;
    ended.notify_all();
    return false;
  }

  /// @return whether to continue
  bool call_tick() {
    const std::int64_t now = monotonic_ns();
    if (last_call < 0) begin();
    Tick turn;
    turn.asked = last_call < 0 ? now : std::min(last_call + device_period, now);
    turn.woken = now;
    last_call = now;
    if (now < start) return true;
    turn.period = (now - start) / period;
    turn.skipped = std::max<std::int64_t>(turn.period - last_period - 1, 0);
    last_period = turn.period;
    return tick(turn);
  }
};

}  // namespace

void call_on_grid(std::int64_t start, std::int64_t period, const ServoTick& tick) {
  TickGrid grid(start, period);
  while (tick(grid.wait())) {
  }
}

void DeviceScheduler::start(double rate_hz, Callback callback, void* user_data) {
  stopped_ = false;
  thread_ = std::thread([this, rate_hz, callback, user_data] {
    const auto period = static_cast<std::int64_t>(1e9 / rate_hz);
    TickGrid grid(monotonic_ns() + period, period);
    while (!stopped_) {
      grid.wait();
      if (!callback(user_data)) break;
    }
  });
}

void DeviceScheduler::stop() {
  stopped_ = true;
  if (thread_.joinable()) thread_.join();
}

void call_from_device(DeviceScheduler& scheduler, double rate_hz, std::int64_t start, std::int64_t period,
                      const std::function<void()>& begin, const ServoTick& tick) {
  DeviceCalls calls{start, period, static_cast<std::int64_t>(1e9 / rate_hz), begin, tick};
  scheduler.start(
      rate_hz, [](void* user_data) { return static_cast<DeviceCalls*>(user_data)->call(); }, &calls);
  calls.ended.wait(false);
  scheduler.stop();
  if (calls.error) std::rethrow_exception(calls.error);
}

}  // namespace lmdbench
