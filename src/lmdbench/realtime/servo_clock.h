// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

/// The clock of loops that must keep a grid of instants (POSIX clock_nanosleep with absolute deadlines on CLOCK_MONOTONIC).
/// All times are nanoseconds of that clock.
namespace lmdbench {

std::int64_t monotonic_ns();

/// Sleeps until an instant; returns at once where it is past.
void sleep_until_ns(std::int64_t instant);

/// One turn of a loop.
struct Tick {
  std::int64_t asked = 0;  ///< Instant that the loop slept until.
  std::int64_t woken = 0;  ///< When it went on.
  std::int64_t period =
      0;  ///< Which instant of the grid the tick is for, counted from 0: the last one that is not in the future.
  std::int64_t skipped = 0;  ///< Instants of the grid since the last tick that got none.
};

/// The grid start + n * period. A loop that is late goes on with the last instant that has come; those before it are skipped
/// and counted, never made up for in a burst: a device that was not served for ten periods is not helped by ten forces at once.
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

/// The control loop: the same grid with nothing in it. What it is late by is the machine's own.
/// Runs in the calling thread, whose policy it has. Ticks and skipped instants are `ticks` together.
TickTimes run_empty_loop(std::int64_t period, std::int64_t ticks);

/// Whether the calling thread is inside a servo tick, where nothing may be allocated, locked, faulted in or written. The loop
/// sets it; tests that replace the allocator and the mutexes count what happens while it is set.
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
