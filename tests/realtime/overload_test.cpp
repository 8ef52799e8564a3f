// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/driver.h>
#include <lmdbench/realtime/servo_clock.h>

#include <gtest/gtest.h>
#include <realtime/clock_scene.h>

#include <algorithm>
#include <cstdint>

namespace lmdbench {
namespace {

using testing::clock_method;
using testing::count_frames;
using testing::quick;
using testing::straight_path;

constexpr std::int64_t MS = 1'000'000;

std::int64_t longest(const std::vector<std::int64_t>& durations) {
  return *std::max_element(durations.begin(), durations.end());
}

/// Under every planted fault all frames exist, and each period has a tick or is counted as missed.
void expect_nothing_uncounted(const RealtimeRun& run, std::int64_t frames) {
  const RealtimeRecord& clock = run.clocks[0];
  const auto counts = count_frames(clock);
  EXPECT_EQ(counts.ticks + counts.skipped + counts.lost, frames);
  EXPECT_EQ(static_cast<std::int64_t>(run.records[0].frames.size()), frames);
  EXPECT_EQ(counts.ticks + clock.servo().lost, clock.servo().turns);
  for (std::size_t i = 1; i < clock.tick_frame.size(); ++i)
    EXPECT_GT(clock.tick_frame[i], clock.tick_frame[i - 1]);
}

/// A run of a method that tracks, with this fault.
RealtimeRun run_planted(const PlantedOverload& plant, std::int64_t frames) {
  RealtimeSettings settings = quick();
  settings.choice.plant = plant;
  RealtimeRun run = run_realtime({clock_method(true)}, straight_path(frames), settings, {});
  expect_nothing_uncounted(run, frames);
  return run;
}

TEST(Overload, ASearchThatSleepsMakesSetsOldAndNoTickLate) {
  const RealtimeRun run = run_planted({.search_sleep_s = 0.1, .stopped_role = {}}, 1000);
  const RealtimeRecord& clock = run.clocks[0];
  EXPECT_LE(clock.roles[1].turns, 11) << "searches of 100 ms in a second";
  EXPECT_GT(longest(clock.search_age), 100 * MS);
  EXPECT_GT(clock.servo().turns, 20 * clock.roles[1].turns) << "ticks went on meanwhile";
}

TEST(Overload, AStalledRecorderLosesRecordsAndSaysHowMany) {
  constexpr std::int64_t FRAMES = 1000;
  RealtimeSettings settings = quick();
  settings.choice.plant.recorder_stall_s = 0.7;
  settings.choice.queue_ticks = 32;
  DriverInput input = straight_path(FRAMES);
  input.keep_lmds = [](std::int64_t) { return true; };
  const RealtimeRun run = run_realtime({clock_method(false)}, input, settings, {});
  expect_nothing_uncounted(run, FRAMES);
  const RealtimeRecord& clock = run.clocks[0];
  EXPECT_GT(clock.servo().lost, 0);
  EXPECT_GT(count_frames(clock).lost, 0);
  for (const auto& [frame, lmds] : run.records[0].lmds)
    EXPECT_NE(clock.frame_source[static_cast<std::size_t>(frame)], FrameSource::LOST)
        << "nobody knows that list";
}

TEST(Overload, AStoppedTrackingLeavesTheLastSet) {
  const RealtimeRun run = run_planted({.stopped_role = "tracking", .stop_s = 0.3}, 1000);
  EXPECT_GT(longest(run.clocks[0].servo().age), 290 * MS);
}

TEST(Overload, AStoppedSearchLeavesTheSetsOfTheLast) {
  const RealtimeRun run = run_planted({.stopped_role = "search", .stop_s = 0.3}, 1000);
  EXPECT_GT(longest(run.clocks[0].search_age), 290 * MS);
}

TEST(Overload, ABusyNeighbourOfTheSamePriorityCostsTicksThatAreCounted) {
  const RealtimeRun run = run_planted({.neighbour_busy_s = 0.01, .stopped_role = {}}, 500);
  // SCHED_FIFO does not interrupt a neighbour of equal priority; the normal policy shares the core.
  const auto& grants = run.clocks[0].grants;
  const bool all =
      std::all_of(grants.begin(), grants.end(), [](const Grant& grant) { return grant.granted; });
  if (!all) GTEST_SKIP() << "the system grants no real-time priority";
  EXPECT_GT(count_frames(run.clocks[0]).skipped, 20);
}

TEST(Overload, AServoLoopThatIsTooSlowSkipsAndKeepsItsGrid) {
  constexpr std::int64_t FRAMES = 400;
  const auto slow = [] { sleep_until_ns(monotonic_ns() + 5 * MS / 2); };
  const RealtimeRun run = run_realtime({clock_method(false, slow)}, straight_path(FRAMES), quick(), {});
  expect_nothing_uncounted(run, FRAMES);
  const auto counts = count_frames(run.clocks[0]);
  EXPECT_LE(counts.ticks, FRAMES / 2) << "2.5 ms do not fit into 1 ms";
  EXPECT_GT(counts.skipped, 0);
}

}  // namespace
}  // namespace lmdbench
