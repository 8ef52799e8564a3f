// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/servo_clock.h>

#include <gtest/gtest.h>

#include <cstdint>

namespace lmdbench {
namespace {

constexpr std::int64_t MILLISECOND = 1'000'000;

void busy_for(std::int64_t duration) {
  const std::int64_t end = monotonic_ns() + duration;
  while (monotonic_ns() < end) {
  }
}

TEST(TickGrid, EveryTickIsForTheLastInstantThatHasCome) {
  const std::int64_t start = monotonic_ns() + 5 * MILLISECOND;
  TickGrid grid(start, 2 * MILLISECOND);
  std::int64_t last = -1, skipped = 0;
  for (int turn = 0; turn < 50; ++turn) {
    const Tick tick = grid.wait();
    EXPECT_GE(tick.woken, tick.asked) << "never early";
    EXPECT_EQ((tick.asked - start) % (2 * MILLISECOND), 0) << "on the grid";
    EXPECT_EQ(tick.period, (tick.woken - start) / (2 * MILLISECOND));
    EXPECT_EQ(tick.period, last + 1 + tick.skipped);
    last = tick.period;
    skipped += tick.skipped;
  }
  EXPECT_EQ(last + 1, 50 + skipped);
}

TEST(TickGrid, AStallIsSkippedAndCountedAndNotMadeUpFor) {
  const std::int64_t start = monotonic_ns() + MILLISECOND;
  TickGrid grid(start, MILLISECOND);
  grid.wait();
  busy_for(20 * MILLISECOND);
  const Tick late = grid.wait();
  EXPECT_GE(late.skipped, 18);
  EXPECT_EQ(late.period, (late.woken - start) / MILLISECOND);
  // One tick at once, and the next one on the grid again.
  const Tick next = grid.wait();
  EXPECT_GE(next.asked, start + (late.period + 1) * MILLISECOND);
  EXPECT_GE(next.woken, next.asked);
}

TEST(TickGrid, ATickThatIsLateByLessThanAPeriodLosesNone) {
  const std::int64_t start = monotonic_ns() + 20 * MILLISECOND;
  TickGrid grid(start, 20 * MILLISECOND);
  const Tick first = grid.wait();
  busy_for(25 * MILLISECOND);
  const Tick second = grid.wait();
  EXPECT_EQ(second.asked, first.asked + (second.period - second.skipped - first.period) * 20 * MILLISECOND);
  EXPECT_EQ(second.period, (second.woken - start) / (20 * MILLISECOND));
}

TEST(RunEmptyLoop, LeavesOneRowATick) {
  const TickTimes times = run_empty_loop(MILLISECOND, 30);
  EXPECT_EQ(static_cast<std::int64_t>(times.size()) + times.skipped, 30);
  ASSERT_EQ(times.asked.size(), times.woken.size());
  ASSERT_EQ(times.asked.size(), times.done.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_LE(times.asked[i], times.woken[i]);
    EXPECT_LE(times.woken[i], times.done[i]);
  }
}

}  // namespace
}  // namespace lmdbench
