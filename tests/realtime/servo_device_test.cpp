// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/servo_device.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace lmdbench {
namespace {

constexpr std::int64_t TICK_NS = 1'000'000;

LoopChoice free_mass(double mass, std::int64_t delay = 0) {
  LoopChoice loop;
  loop.closed = true;
  loop.dynamics = {mass, 0.0, 0.0, std::nullopt};
  loop.delay_frames = delay;
  return loop;
}

RenderedForce push_of(double newtons) {
  RenderedForce rendered;
  rendered.force = Vec3(newtons, 0.0, 0.0);
  return rendered;
}

/// The same device in lockstep, and on a clock whose ticks are all in time and take no time.
TEST(SimulatedServoDevice, InTimeItIsTheLockstepsDevice) {
  LoopChoice loop = free_mass(0.1, 2);
  loop.dynamics.damping_n_s_per_m = 3.0;
  loop.dynamics.friction_n = 0.02;
  loop.dynamics.hand = Hand{"custom", 0.5, 6.0, 130.0};
  std::vector<Pose> path(300);
  for (std::size_t i = 0; i < path.size(); ++i) path[i].translation.y() = 1e-5 * static_cast<double>(i);
  DevicePoses lockstep(loop, path, 1e-3);
  SimulatedServoDevice clock(loop, path, 0, TICK_NS, 10, 1.0, Vec3::Zero());
  for (std::int64_t tick = 0; tick < 300; ++tick) {
    const Vec3 there = lockstep.pose().translation;
    const Vec3 here = clock.sense(tick, tick * TICK_NS).translation;
    ASSERT_LT((here - there).norm(), 1e-9) << "tick " << tick;
    const RenderedForce rendered = push_of(-500.0 * here.y());
    const auto frame = lockstep.render(rendered);
    clock.render(rendered, tick * TICK_NS);
    EXPECT_EQ(clock.moved()->held.force, frame->held.force) << "tick " << tick;
  }
}

TEST(SimulatedServoDevice, AForceThatComesLateActsLate) {
  // x = F/m t^2 / 2 from the instant when the force is first there.
  const std::vector<Pose> path(20);
  for (const std::int64_t late : {std::int64_t{0}, 3 * TICK_NS / 10}) {
    SimulatedServoDevice device(free_mass(0.1), path, 0, TICK_NS, 10, 1.0, Vec3::Zero());
    device.sense(0, 0);
    device.render(push_of(1.0), late);
    const double x = device.sense(10, 10 * TICK_NS).translation.x();
    const double acting = 1e-9 * static_cast<double>(10 * TICK_NS - late);
    EXPECT_NEAR(x, 0.5 * 10.0 * acting * acting, 1e-12);
  }
}

TEST(SimulatedServoDevice, GoesOnUnderTheLastForceWhileNoTickComes) {
  const std::vector<Pose> path(50);
  SimulatedServoDevice device(free_mass(0.1), path, 0, TICK_NS, 10, 1.0, Vec3::Zero());
  device.sense(0, 0);
  device.render(push_of(1.0), 0);
  EXPECT_NEAR(device.sense(30, 30 * TICK_NS).translation.x(), 0.5 * 10.0 * 0.03 * 0.03, 1e-12);
  EXPECT_NEAR(device.moved()->velocity.x(), 10.0 * 0.03, 1e-12);
  EXPECT_EQ(device.moved()->held.force.x(), 1.0);
}

TEST(SimulatedServoDevice, HoldsForcesAfterTheirDelay) {
  const std::vector<Pose> path(50);
  SimulatedServoDevice device(free_mass(0.1, 4), path, 0, TICK_NS, 10, 1.0, Vec3::Zero());
  for (std::int64_t tick = 0; tick < 20; ++tick) {
    device.sense(tick, tick * TICK_NS);
    device.render(push_of(static_cast<double>(tick)), tick * TICK_NS);
    EXPECT_EQ(device.moved()->held.force.x(), tick >= 4 ? static_cast<double>(tick - 4) : 0.0);
  }
}

TEST(SimulatedServoDevice, ADeviceThatCallsOftenHoldsForcesAfterTheirDelay) {
  const std::vector<Pose> path(50);
  constexpr std::int64_t CALLS = 10, DELAY = 12;
  SimulatedServoDevice device(free_mass(0.1, DELAY), path, 0, TICK_NS, 10, CALLS, Vec3::Zero());
  for (std::int64_t call = 0; call < 30 * CALLS; ++call) {
    const std::int64_t now = call * TICK_NS / CALLS;
    device.sense(call / CALLS, now);
    device.render(push_of(static_cast<double>(call)), now);
    const std::int64_t held = call - DELAY * CALLS;
    EXPECT_EQ(device.moved()->held.force.x(), held >= 0 ? static_cast<double>(held) : 0.0);
  }
}

TEST(RecordedDevice, StaysAtItsLastPose) {
  std::vector<Pose> path(2);
  path[1].translation.x() = 1.0;
  RecordedDevice device(path);
  EXPECT_EQ(device.sense(0, 0).translation.x(), 0.0);
  EXPECT_EQ(device.sense(1, 0).translation.x(), 1.0);
  EXPECT_EQ(device.sense(7, 0).translation.x(), 1.0);
  EXPECT_EQ(device.moved(), nullptr);
}

}  // namespace
}  // namespace lmdbench
