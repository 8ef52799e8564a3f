// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/servo_clock.h>

#include <cerrno>
#include <cstddef>
#include <ctime>

namespace lmdbench {
namespace {

constexpr std::int64_t NS_PER_S = 1'000'000'000;

}  // namespace

std::int64_t monotonic_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * NS_PER_S + now.tv_nsec;
}

void sleep_until_ns(std::int64_t instant) {
  timespec until{};
  until.tv_sec = instant / NS_PER_S;
  until.tv_nsec = instant % NS_PER_S;
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

void TickTimes::reserve(std::size_t count) {
  for (std::vector<std::int64_t>* column : {&asked, &woken, &done}) {
    // Touches every page before the loop.
    column->assign(count, 0);
    column->clear();
  }
}

void TickTimes::add(const Tick& tick, std::int64_t done_at) {
  asked.push_back(tick.asked);
  woken.push_back(tick.woken);
  done.push_back(done_at);
  skipped += tick.skipped;
}

TickTimes run_empty_loop(std::int64_t period, std::int64_t ticks) {
  TickTimes times;
  times.reserve(static_cast<std::size_t>(ticks));
  TickGrid grid(monotonic_ns() + period, period);
  for (std::int64_t next = 0; next < ticks;) {
    const Tick tick = grid.wait();
    const ServoWatch watch;
    if (tick.period >= ticks) {
      // A stall lasted beyond the end: the remaining instants have no tick.
      times.skipped += ticks - next;
      break;
    }
    times.add(tick, monotonic_ns());
    next = tick.period + 1;
  }
  return times;
}

}  // namespace lmdbench
