// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

/// The clock of loops on a grid of instants (POSIX clock_nanosleep with absolute deadlines on
/// CLOCK_MONOTONIC). All times are nanoseconds of that clock.
namespace lmdbench {

std::int64_t monotonic_ns();

/// Sleeps until an instant; returns at once where it is past.
void sleep_until_ns(std::int64_t instant);

/// One turn of a loop.
struct Tick {
  std::int64_t asked = 0;    ///< Instant that the loop waited for.
  std::int64_t woken = 0;    ///< When it continued.
  std::int64_t period = 0;   ///< Its instant, from 0: the last not in the future.
  std::int64_t skipped = 0;  ///< Instants without a tick since the last one.
};

/// The grid start + n * period. A late loop continues with the last instant that has come. Earlier
/// ones are skipped and counted, never made up for in a burst: ten forces at once do not help a
/// device after ten missed periods.
class TickGrid {
 public:
  TickGrid(std::int64_t start, std::int64_t period) : period_(period), start_(start) {}

  /// Sleeps until the next instant.
  Tick wait() {
    Tick tick;
    tick.asked = start_ + next_ * period_;
    sleep_until_ns(tick.asked);
    tick.woken = monotonic_ns();
    const std::int64_t passed = tick.woken > tick.asked ? (tick.woken - tick.asked) / period_ : 0;
    tick.period = next_ + passed;
    tick.skipped = passed;
    next_ = tick.period + 1;
    return tick;
  }
  std::int64_t period() const { return period_; }

 private:
  std::int64_t period_;
  std::int64_t start_;
  std::int64_t next_ = 0;
};

/// The times of a loop's ticks.
struct TickTimes {
  std::vector<std::int64_t> asked, woken, done;
  std::int64_t skipped = 0;  ///< Instants without a tick.

  void reserve(std::size_t count);
  void add(const Tick& tick, std::int64_t done_at);
  std::size_t size() const { return asked.size(); }
};

/// The control loop: the same grid without work. Its lateness is the machine's own.
/// Runs in the calling thread, under its policy. `ticks` counts ticks and skipped instants.
TickTimes run_empty_loop(std::int64_t period, std::int64_t ticks);

/// Whether the calling thread is inside a servo tick, which may not allocate, lock, fault in or
/// write. The loop sets it; tests that replace allocator and mutexes count what happens meanwhile.
inline thread_local bool in_servo_tick = false;

/// Sets it for a scope.
class ServoWatch {
 public:
  ServoWatch() { in_servo_tick = true; }
  ~ServoWatch() { in_servo_tick = false; }
  ServoWatch(const ServoWatch&) = delete;
  ServoWatch& operator=(const ServoWatch&) = delete;
};

}  // namespace lmdbench
