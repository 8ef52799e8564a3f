// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/prepare/scene_path.h>
#include <lmdbench/realtime/driver.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <realtime/clock_scene.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

namespace lmdbench {
namespace {

using testing::clock_method;
using testing::count_frames;
using testing::quick;
using testing::straight_path;

/// Checks the grid: no tick before its instant, at most one per period, and else a skip is counted.
void expect_grid(const RealtimeRecord& clock, std::int64_t frames) {
  const TickTimes& times = clock.servo().times;
  ASSERT_EQ(times.size(), clock.tick_frame.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ((times.asked[i] - clock.start) % clock.period, 0);
    EXPECT_LE(times.asked[i], times.woken[i]);
    EXPECT_LE(times.woken[i], times.done[i]);
    EXPECT_EQ(clock.tick_frame[i], (times.woken[i] - clock.start) / clock.period);
    if (i > 0) {
      EXPECT_GT(clock.tick_frame[i], clock.tick_frame[i - 1]);
    }
  }
  EXPECT_EQ(static_cast<std::int64_t>(clock.frame_source.size()), frames);
}

TEST(RealtimeDriver, EveryFrameIsATickOrAKnownSkip) {
  constexpr std::int64_t FRAMES = 400;
  DriverInput input = straight_path(FRAMES);
  input.keep_lmds = [](std::int64_t frame) { return frame % 10 == 0; };
  const RealtimeRun run = run_realtime({clock_method(false)}, input, quick(), {});
  const MethodRecord& record = run.records.at(0);
  const RealtimeRecord& clock = run.clocks.at(0);
  expect_grid(clock, FRAMES);
  const auto counts = count_frames(clock);
  EXPECT_EQ(counts.ticks + counts.skipped, FRAMES);
  EXPECT_EQ(clock.servo().turns, counts.ticks);
  ASSERT_EQ(static_cast<std::int64_t>(record.frames.size()), FRAMES);
  std::int64_t last_tick = -1;
  for (std::int64_t frame = 0; frame < FRAMES; ++frame) {
    const auto at = static_cast<std::size_t>(frame);
    if (clock.frame_source[at] == FrameSource::TICK) last_tick = frame;
    if (last_tick < 0) continue;
    EXPECT_DOUBLE_EQ(-record.frames[at].force.z(), testing::force_at(last_tick)) << "frame " << frame;
    EXPECT_NEAR(record.frames[at].lmd_age, 1e-3 * static_cast<double>(frame - last_tick), 1e-12);
    EXPECT_EQ(std::isnan(record.repetitions[0].local_update[at]), frame != last_tick);
    if (frame == last_tick) {
      EXPECT_EQ(record.lmds.count(frame), frame % 10 == 0 ? 1u : 0u);
    }
  }
  EXPECT_EQ(clock.roles.size(), 2u) << "no search, no tracking";
  EXPECT_GT(clock.floor_before.size(), 0u);
  EXPECT_GT(clock.floor_after.size(), 0u);
}

TEST(RealtimeDriver, FourRolesHandOverAndSayHowOldTheirSetsAre) {
  constexpr std::int64_t FRAMES = 500;
  const RealtimeRun run = run_realtime({clock_method(true)}, straight_path(FRAMES), quick(), {});
  const RealtimeRecord& clock = run.clocks.at(0);
  const MethodRecord& record = run.records.at(0);
  expect_grid(clock, FRAMES);
  ASSERT_EQ(clock.roles.size(), 4u);
  for (const RoleRecord& role : clock.roles) {
    EXPECT_GT(role.turns, 5) << role.name;
    EXPECT_GT(role.use.processor_ns, 0) << role.name;
    EXPECT_GT(role.rate_hz(), 0.0) << role.name;
  }
  // Every set is as old as the record says: its force belongs to a pose that long ago.
  for (std::size_t i = 0; i < clock.tick_frame.size(); ++i) {
    EXPECT_GT(clock.servo().age[i], 0);
    EXPECT_GE(clock.search_age[i], clock.servo().age[i]) << "a set is tracked after it is searched";
    const double force = -record.frames[static_cast<std::size_t>(clock.tick_frame[i])].force.z();
    const double sensed = std::round((1.0 - force - 0.1) * 1e6);
    const double then =
        1e-6 * static_cast<double>(clock.servo().times.woken[i] - clock.servo().age[i] - clock.start);
    // Before the clock started the mesh was at the first pose.
    EXPECT_EQ(sensed, std::max(std::floor(then), 0.0)) << "tick " << i;
  }
  ASSERT_FALSE(record.searches.empty());
  for (std::size_t i = 1; i < record.searches.size(); ++i)
    EXPECT_GT(record.searches[i].frame, record.searches[i - 1].frame);
  EXPECT_EQ(record.repetitions[0].global_search.size(), record.searches.size());
}

/// Many ticks use the set of one update: its work is recorded with the first of them.
TEST(RealtimeDriver, AnUpdateIsRecordedOnce) {
  RealtimeSettings settings = quick();
  settings.choice.tracking_rate_hz = 100.0;
  const RealtimeRun run = run_realtime({clock_method(true)}, straight_path(500), settings, {});
  std::int64_t updates = 0;
  for (const double time : run.records.at(0).repetitions.at(0).local_update) updates += time >= 0.0 ? 1 : 0;
  EXPECT_GT(updates, 0);
  EXPECT_LE(updates, run.clocks.at(0).roles.at(2).turns);
}

TEST(RealtimeDriver, AFreeLoopIsCountedFromItsBegin) {
  RealtimeSettings settings = quick();
  settings.choice.plant.search_sleep_s = 0.005;
  const RealtimeRun run = run_realtime({clock_method(true)}, straight_path(60), settings, {});
  const RoleRecord& search = run.clocks[0].roles[1];
  EXPECT_GT(search.turns, 0);
  EXPECT_GE(search.ran_ns, 5'000'000 * search.turns) << "it begins before the clock starts";
}

TEST(RealtimeDriver, PredictionLooksAheadByTheAge) {
  RealtimeSettings settings = quick();
  settings.predict = true;
  const RealtimeRun run = run_realtime({clock_method(true)}, straight_path(500), settings, {});
  const RealtimeRecord& clock = run.clocks.at(0);
  // On a straight path at constant speed the prediction is right where ticks are in time.
  std::vector<double> errors;
  for (std::size_t i = 10; i < clock.tick_frame.size(); ++i) {
    const std::int64_t frame = clock.tick_frame[i];
    errors.push_back(std::abs(-run.records[0].frames[static_cast<std::size_t>(frame)].force.z() -
                              testing::force_at(frame)));
  }
  ASSERT_GT(errors.size(), 50u);
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                   errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.5e-6) << "a tick of age is 1e-6 N without prediction";
}

TEST(RealtimeDriver, CertifiedGivesTheLockstepsForces) {
  constexpr std::int64_t FRAMES = 300;
  const testing::BlobRun blobs(FRAMES);
  const DrivenMethod certified = blobs.method("certified");
  const RealtimeRun run = run_realtime({certified}, blobs.input, quick(), {});
  const std::vector<MethodRecord> lockstep = run_lockstep({certified}, blobs.input, {1, 0, 1, 100}, {});
  std::int64_t compared = 0;
  for (std::int64_t frame = 0; frame < FRAMES; ++frame) {
    const auto at = static_cast<std::size_t>(frame);
    if (run.clocks[0].frame_source[at] != FrameSource::TICK) continue;
    EXPECT_EQ(run.records[0].frames[at].force, lockstep[0].frames[at].force) << "frame " << frame;
    ++compared;
  }
  EXPECT_GT(compared, FRAMES / 4);
}

TEST(RealtimeDriver, TheImprovedMethodsForcesAreThoseOfAFewTicksAgo) {
  constexpr std::int64_t FRAMES = 400;
  const testing::BlobRun blobs(FRAMES);
  const DrivenMethod improved = blobs.method("improved");
  const RealtimeRun run = run_realtime({improved}, blobs.input, quick(), {});
  std::int64_t with_force = 0;
  for (const FrameRecord& frame : run.records[0].frames) with_force += frame.lmd_count > 0 ? 1 : 0;
  EXPECT_GT(with_force, FRAMES / 2);
  EXPECT_GT(run.records[0].searches.size(), 3u);
}

TEST(RealtimeDriver, ADeviceMayCallAtARateOfItsOwn) {
  constexpr std::int64_t FRAMES = 600;
  RealtimeSettings settings = quick();
  settings.choice.caller = ServoCaller::CALLBACK;
  settings.choice.callback_rate_hz = 250.0;
  const RealtimeRun slow = run_realtime({clock_method(true)}, straight_path(FRAMES), settings, {});
  EXPECT_LE(slow.clocks[0].servo().turns, FRAMES / 4 + 2);
  EXPECT_GT(slow.clocks[0].servo().turns, 10);
  const auto counts = count_frames(slow.clocks[0]);
  EXPECT_EQ(counts.ticks + counts.skipped, FRAMES);
  // A late call may fall into the frame of the next one.
  EXPECT_LE(counts.ticks, slow.clocks[0].servo().turns);
  EXPECT_GT(counts.ticks, 10);

  settings.choice.callback_rate_hz = 3000.0;
  const RealtimeRun fast = run_realtime({clock_method(false)}, straight_path(FRAMES), settings, {});
  EXPECT_EQ(fast.clocks[0].servo().times.size(), fast.clocks[0].tick_frame.size());
  EXPECT_EQ(static_cast<std::int64_t>(fast.records[0].frames.size()), FRAMES);
  EXPECT_GT(fast.clocks[0].servo().turns, count_frames(fast.clocks[0]).ticks) << "several ticks a period";
}

TEST(RealtimeDriver, AStoppedRunIsInterrupted) {
  int told = 0;
  const auto stop = [&](std::int64_t, std::int64_t) { return ++told < 3; };
  EXPECT_THROW(run_realtime({clock_method(true)}, straight_path(100000), quick(), stop), Interrupted);
}

TEST(RealtimeDriver, AnErrorInARoleEndsTheRun) {
  int searches = 0;
  const auto fails = [&searches] {
    if (++searches > 3) throw InputError("mesh", "", "is broken", "mend it");
  };
  EXPECT_THROW(run_realtime({clock_method(true, fails)}, straight_path(2000), quick(), {}), InputError);
}

TEST(RealtimeDriver, RefusalsAreRecordedAndEndARunThatRequires) {
  // Drops root's capabilities, whoever runs the test.
  const auto as_nobody = [](bool required) {
    if (::geteuid() == 0 && ::setuid(65534) != 0) std::exit(9);
    RealtimeSettings settings = quick();
    settings.choice.required = required;
    settings.choice.lock_memory = false;
    try {
      const RealtimeRun run = run_realtime({clock_method(true)}, straight_path(100), settings, {});
      std::int64_t refused = 0;
      for (const Grant& grant : run.clocks[0].grants) refused += grant.granted ? 0 : 1;
      std::cerr << "went on, refused " << (refused > 0 ? "some" : "none") << "\n";
    } catch (const EnvironmentError& error) {
      std::cerr << error.what() << "\n";
      std::exit(4);
    }
    std::exit(0);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  // The thread of the servo or of the tracking, whichever asks first.
  EXPECT_EXIT(as_nobody(true), ::testing::ExitedWithCode(4), "SCHED_FIFO [78]0 was refused.*CAP_SYS_NICE");
  EXPECT_EXIT(as_nobody(false), ::testing::ExitedWithCode(0), "went on, refused some");
}

TEST(Lengthen, GoesThereAndBackUntilTheTimeIsOver) {
  std::vector<Pose> poses(3);
  for (int i = 0; i < 3; ++i) poses[static_cast<std::size_t>(i)].translation.x() = i;
  std::vector<double> times{5.0, 5.001, 5.002};
  lengthen(poses, times, 1000.0, 0.007, "e.json");
  std::vector<double> x;
  for (const Pose& pose : poses) x.push_back(pose.translation.x());
  EXPECT_THAT(x, ::testing::ElementsAre(0, 1, 2, 1, 0, 1, 2, 1));
  EXPECT_DOUBLE_EQ(times.front(), 5.0) << "as the path counts";
  EXPECT_DOUBLE_EQ(times.back(), 5.007);
  lengthen(poses, times, 1000.0, 0.002, "e.json");
  EXPECT_THROW(lengthen(poses, times, 1000.0, 1e9, "e.json"), UsageError) << "the limit of frames";
  EXPECT_EQ(poses.size(), 3u) << "a run may be shorter than its path";
}

}  // namespace
}  // namespace lmdbench
