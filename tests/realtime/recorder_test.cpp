// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/recorder.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace lmdbench {
namespace {

/// A device that calls late was where its path begins.
TEST(RealtimeRecorder, BeforeTheFirstTickTheDeviceStandsAtItsStart) {
  constexpr std::int64_t FRAMES = 6, FIRST = 3;
  RecordQueues queues(16, 16);
  const std::vector<char> kept(FRAMES, 1);
  const Pose start{Vec3(0.1, 0.2, 0.3), Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vec3::UnitX()))};
  RealtimeRecorder recorder(queues, "method", FRAMES, true, start, kept, nullptr, 0);
  TickRecord tick;
  tick.tick.period = FIRST;
  tick.pose.translation = Vec3(9, 9, 9);
  tick.loop.position = Vec3(9, 9, 9);
  queues.ticks.push(tick);
  recorder.finish();
  const MethodRecord& record = recorder.record;
  ASSERT_EQ(std::ssize(record.poses), FRAMES);
  ASSERT_EQ(std::ssize(record.loop), FRAMES);
  for (std::size_t frame = 0; frame < FRAMES; ++frame) {
    const bool waits = frame < FIRST;
    EXPECT_EQ(record.poses[frame].translation, waits ? start.translation : Vec3(9, 9, 9)) << frame;
    EXPECT_EQ(record.loop[frame].position, waits ? start.translation : Vec3(9, 9, 9)) << frame;
    if (waits) {
      EXPECT_EQ(record.loop[frame].orientation.coeffs(), start.rotation.coeffs());
    }
  }
}

/// Of two ticks in a period the first one is the frame; what is held over skipped frames, with its
/// LMDs, is the second one's.
TEST(RealtimeRecorder, OverSkippedFramesTheLastTickIsHeld) {
  constexpr std::int64_t FRAMES = 4;
  RecordQueues queues(16, 16);
  const std::vector<char> kept(FRAMES, 1);
  RealtimeRecorder recorder(queues, "method", FRAMES, true, Pose(), kept, nullptr, 0);
  for (int k = 0; k < 2; ++k) {
    TickRecord tick;
    tick.sequence = k;
    tick.frame.force = Vec3(k + 1.0, 0, 0);
    tick.pose.translation = Vec3(k + 1.0, 0, 0);
    tick.loop.position = Vec3(k + 1.0, 0, 0);
    tick.list = 1;
    Lmd lmd;
    lmd.distance = k + 1.0;
    queues.lists.push(lmd);
    queues.ticks.push(tick);
  }
  TickRecord last;
  last.sequence = 2;
  last.tick.period = FRAMES - 1;
  queues.ticks.push(last);
  recorder.finish();
  const MethodRecord& record = recorder.record;
  ASSERT_EQ(std::ssize(record.frames), FRAMES);
  for (std::size_t frame = 0; frame < 3; ++frame) {
    const double held = frame == 0 ? 1.0 : 2.0;
    EXPECT_EQ(record.frames[frame].force.x(), held) << frame;
    EXPECT_EQ(record.poses[frame].translation.x(), held) << frame;
    EXPECT_EQ(record.loop[frame].position.x(), held) << frame;
    ASSERT_EQ(record.lmds.at(static_cast<std::int64_t>(frame)).size(), 1U) << frame;
    EXPECT_EQ(record.lmds.at(static_cast<std::int64_t>(frame)).front().distance, held) << frame;
  }
}

}  // namespace
}  // namespace lmdbench
