// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/drivers/pose_source.h>
#include <lmdbench/metrics/summary.h>
#include <lmdbench/motion/tum_file.h>
#include <lmdbench/result/run_to_file.h>
#include <lmdbench/run/record_path.h>
#include <lmdbench/run/run.h>

#include <gtest/gtest.h>
#include <result_file/result_reading.h>
#include <support/committed.h>
#include <support/source_directory.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using testing::OpenResult;
using testing::ScratchDirectory;

Experiment wall(std::vector<Override> overrides = {}) {
  overrides.insert(overrides.begin(), {"/frames=600", "/loop/push_n=[0, 0, -6]"});
  return load_experiment(testing::WALL_FILE, overrides);
}

LoopChoice loop_of(double mass, std::int64_t delay) {
  LoopChoice loop;
  loop.closed = true;
  loop.dynamics = {mass, 0.0, 0.0, std::nullopt};
  loop.delay_frames = delay;
  return loop;
}

TEST(DevicePoses, ForceActsAfterItsDelay) {
  for (const std::int64_t delay : {0, 1, 4}) {
    DevicePoses poses(loop_of(0.1, delay), std::vector<Pose>(10), 1e-3);
    poses.render({Vec3(1.0, 0.0, 0.0)});
    for (std::int64_t frame = 0; frame < delay; ++frame) {
      EXPECT_EQ(poses.pose().translation.x(), 0.0) << "delay " << delay << ", frame " << frame;
      const LoopFrame waiting = poses.render({}).value();
      EXPECT_EQ(waiting.held.force.x(), frame + 1 == delay ? 1.0 : 0.0);
    }
    EXPECT_NEAR(poses.pose().translation.x(), 0.5 * 10.0 * 1e-6, 1e-18) << "delay " << delay;
  }
}

TEST(DevicePoses, OrientationIsThePathsAndThePositionInWholeCounts) {
  std::vector<Pose> path(3);
  path[1].rotation = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  LoopChoice loop = loop_of(0.1, 0);
  loop.resolution_m = 1e-6;
  DevicePoses poses(loop, path, 1e-3);
  const LoopFrame start = poses.render({Vec3(0.48, 0.0, 0.0)}).value();
  EXPECT_EQ(start.position.x(), 0.0);
  EXPECT_EQ(poses.pose().rotation.x(), 1.0);
  EXPECT_NEAR(poses.pose().translation.x(), 2e-6, 1e-18) << "2.4 micrometres";
}

/// The path turns a cube over the slab by 10 degrees, until its edge presses, and back.
TEST(ClosedLoop, ATurnOfThePathIsNoEnergyOfTheContact) {
  const ScratchDirectory scratch;
  Path path;
  for (int i = 0; i <= 200; ++i) {
    const double angle = std::sin(std::numbers::pi * i / 200.0) * std::numbers::pi / 18.0;
    path.push_back(
        {0.01 * i, {Vec3(0.0, 0.0, 0.13487), Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitY()))}});
  }
  write_tum(scratch / "turn.tum", path);
  const std::vector<Override> turned{R"(/moving={"mesh":"cube","diagonal_m":0.1})",
                                     "/path/file=" + (scratch / "turn.tum").string(),
                                     "/frames=2001",
                                     "/force/cutoff_m=0.005",
                                     "/force/maximum_force_n=1",
                                     "/loop/push_n=[0, 0, 0]",
                                     "/loop/hand=postural-arm"};
  const Experiment experiment = load_experiment(testing::WALL_FILE, turned);
  const RunResult run = run_experiment(experiment);
  double largest_work = 0.0;
  for (const LoopFrame& frame : run.records[0].loop)
    largest_work = std::max(largest_work, frame.energy.rendered);
  EXPECT_GT(largest_work, 3e-4) << "the turn lifts the device";
  EXPECT_LT(summarise(experiment, run).methods[0].energy_created_j, 0.02 * largest_work);
}

/// Six actuated degrees of freedom: the tip, 50 mm beside the held point, meets the slab and turns.
Experiment lever(std::vector<Override> overrides = {}) {
  overrides.insert(overrides.begin(), {"/frames=600", "/loop/push_n=[0, 0, -2]",
                                       R"(/loop/rotation/hand={"damping_n_m_s": 0.01, "stiffness_n_m": 1})"});
  return load_experiment(testing::LEVER_FILE, overrides);
}

TEST(DevicePoses, SixDegreesTurnTheMeshAboutTheHeldPoint) {
  LoopChoice loop = loop_of(0.1, 0);
  loop.rotation = RotationChoice{{2e-4, 0.0, 0.0, std::nullopt}, 0.0};
  const Vec3 held_M(0.03, -0.01, 0.02);
  std::vector<Pose> path(3);
  path[0].translation = Vec3(1.0, 2.0, 3.0);
  path[0].rotation = Eigen::Quaterniond(0.6, 0.0, 0.8, 0.0);
  DevicePoses poses(loop, path, 1e-3, held_M);
  EXPECT_LT((poses.pose().translation - path[0].translation).norm(), 1e-15);
  const Vec3 held_W = RigidTransform(path[0]).point(held_M);
  RenderedForce twist;
  twist.torque = Vec3(0.0, 0.0, 0.5);
  const LoopFrame start = poses.render(twist).value();
  EXPECT_EQ(start.held.torque, twist.torque);
  for (int n = 0; n < 20; ++n) poses.render(twist);
  const LoopFrame later = poses.render(twist).value();
  EXPECT_LT((RigidTransform(poses.pose()).point(held_M) - held_W).norm(), 1e-14) << "no force, only torque";
  // J w' = t: 0.5 / 2e-4 rad/s^2.
  EXPECT_NEAR(later.angular_velocity.z(), 2500.0 * 21e-3, 1e-10);
  const double angle = 0.5 * 2500.0 * 21e-3 * 21e-3;
  EXPECT_NEAR(later.orientation.angularDistance(path[0].rotation), angle, 1e-10);
  EXPECT_NEAR(later.energy.rendered, 0.5 * angle, 1e-12);
  const Vec3 origin_W = later.position - held_W;
  EXPECT_LT((later.velocity - later.angular_velocity.cross(origin_W)).norm(), 1e-12)
      << "of the mesh's origin";
}

TEST(ClosedLoop, EnergyBalanceClosesWithTheTurn) {
  for (const char* const change :
       {"/loop/delay_frames=0", "/loop/delay_frames=3", "/loop/rotation/friction_n_m=0.002",
        "/loop/hand=hogan-1989", "/loop/rotation/resolution_rad=1e-4", "/loop/rotation/hand=null"}) {
    const RunResult result = run_experiment(lever({change}));
    const std::vector<LoopFrame>& loop = result.records[0].loop;
    ASSERT_EQ(loop.size(), 600u);
    double turned = 0.0;
    double torque = 0.0;
    for (const LoopFrame& frame : loop) {
      ASSERT_LE(frame.energy.balance_error(), 1e-12) << change;
      turned = std::max(turned, frame.orientation.angularDistance(Eigen::Quaterniond::Identity()));
      torque = std::max(torque, frame.held.torque.norm());
    }
    EXPECT_GT(turned, 0.01) << change;
    EXPECT_GT(torque, 0.01) << change;
  }
}

TEST(ClosedLoop, LeverRestsWhereHandPushAndContactBalance) {
  const RunResult result = run_experiment(lever({"/frames=2000"}));
  const FrameRecord& rest = result.records[0].frames.back();
  const LoopFrame& loop = result.records[0].loop.back();
  EXPECT_NEAR(rest.force.z(), 2.0, 0.01);
  const Vec3 turned = 2.0 * loop.orientation.vec();  // small, about the axis y
  EXPECT_NEAR(turned.y(), rest.torque.y(), 0.02 * std::abs(rest.torque.y())) << "1 N m a radian";
  EXPECT_NEAR(rest.torque.y(), -0.05 * 2.0, 0.01);
}

/// Along the recorded path of a closed loop the forces are those of the loop.
void expect_replay(Experiment (*experiment)(std::vector<Override>)) {
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch / "recorded.tum";
  write_tum(file, record_path(experiment({})));
  const RunResult original = run_experiment(experiment({}));
  const RunResult replayed = run_experiment(experiment({"/loop/kind=open", "/path/file=" + file.string()}));
  ASSERT_EQ(replayed.records[0].frames.size(), original.records[0].frames.size());
  for (std::size_t i = 0; i < replayed.records[0].frames.size(); ++i)
    EXPECT_LT((replayed.records[0].frames[i].force - original.records[0].frames[i].force).norm(), 1e-9) << i;
}

TEST(ClosedLoop, RecordedTurnReplaysTheForces) {
  expect_replay(lever);
}

TEST(ClosedLoop, EnergyBalanceOfARunCloses) {
  for (const char* const change :
       {"/loop/delay_frames=0", "/loop/delay_frames=2", "/loop/friction_n=0.05", "/loop/hand=hogan-1989",
        "/loop/hand=speich-2005", "/loop/resolution_m=3e-5"}) {
    const RunResult result = run_experiment(wall({change}));
    const std::vector<LoopFrame>& loop = result.records[0].loop;
    ASSERT_EQ(loop.size(), 600u);
    EXPECT_GT(loop.back().energy.moved, 1e-4) << change << ": it did move";
    for (const LoopFrame& frame : loop) ASSERT_LE(frame.energy.balance_error(), 1e-12) << change;
  }
}

TEST(ClosedLoop, DeviceComesToRestWherePushAndContactBalance) {
  // 10 N at the wall, none at 20 mm: 500 N/m; a push of 6 N rests 12 mm deep, 8 mm above the wall.
  const RunResult result = run_experiment(wall({"/frames=2000"}));
  EXPECT_NEAR(result.records[0].frames.back().force.z(), 6.0, 0.01);
  EXPECT_NEAR(result.records[0].frames.back().minimum_distance, 0.008, 2e-5);
  EXPECT_NEAR(result.records[0].loop.back().velocity.z(), 0.0, 1e-3);
}

TEST(ClosedLoop, IsTheSameEveryTimeAndForEveryMethodAlone) {
  const std::string second = R"(/methods/-={"name": "exhaustive", "force_law": "exponential"})";
  const RunResult alone = run_experiment(wall());
  const RunResult beside = run_experiment(wall({second, "/driver/repetitions=2"}));
  EXPECT_EQ(alone.records[0].result_hash, beside.records[0].result_hash);
  EXPECT_NE(beside.records[0].loop.back().position.z(), beside.records[1].loop.back().position.z())
      << "each method moves a device of its own";
}

TEST(ClosedLoop, TruthIsTakenAtTheDevicesPoses) {
  const RunResult result = run_experiment(wall({"/probes/truth/stride_frames=50"}));
  ASSERT_FALSE(result.comparisons(0).empty());
  for (const TruthComparison& comparison : result.comparisons(0)) EXPECT_LT(comparison.force_error, 1e-9);
}

TEST(ClosedLoop, RecordedPathReplaysTheForces) {
  expect_replay(wall);
  const Experiment closed = wall();
  const Path thinned = record_path(closed, 7);
  const Path all = record_path(closed);
  ASSERT_EQ(thinned.size(), 86u);
  EXPECT_EQ(thinned[85].time, all[595].time);
  EXPECT_EQ(thinned[85].pose.translation, all[595].pose.translation);
  EXPECT_THROW(record_path(wall({"/loop/kind=open"})), UsageError);
  EXPECT_THROW(record_path(wall({"/driver/kind=realtime"})), UsageError) << "it has no clock to run by";
}

/// The hand follows a path in contact, but the device, which nothing presses, is pushed out.
TEST(ClosedLoop, SummaryTellsThePathsContactAndTheDevices) {
  const ScratchDirectory scratch;
  const Experiment released = wall({"/loop/push_n=[0, 0, 0]"});
  run_experiment_to_file(released, scratch / "wall.h5", {"lmdbench", "run"});
  const OpenResult result(scratch / "wall.h5");
  const auto contacts = [&](const std::string& dataset) {
    const std::vector<double> flags = result.doubles(dataset);
    return static_cast<double>(std::count(flags.begin(), flags.end(), 1.0));
  };
  EXPECT_EQ(result.doubles("/summary/frames_in_contact")[0], contacts("/scene/in_contact"));
  EXPECT_EQ(result.doubles("/methods/certified/summary/frames_in_contact")[0],
            contacts("/methods/certified/loop/in_contact"));
  EXPECT_EQ(contacts("/scene/in_contact"), 600.0);
  EXPECT_LT(contacts("/methods/certified/loop/in_contact"), 300.0);
  EXPECT_GT(contacts("/methods/certified/loop/in_contact"), 0.0);
  const RunSummary summary = summarise(released, run_experiment(released));
  const std::string text = summary_text(summary);
  EXPECT_NE(text.find("600 in contact"), std::string::npos) << text;
  EXPECT_NE(summary_table(summary).find("600 in contact on the path that the hand means"), std::string::npos);
  EXPECT_NE(text.find("its device was in contact in"), std::string::npos) << text;
}

TEST(ClosedLoop, ResultHoldsTheDevicesMotion) {
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch / "wall.h5";
  run_experiment_to_file(wall(), file, {"lmdbench", "run"});
  const OpenResult result(file);
  for (const char* const name :
       {"position", "velocity", "held_force", "energy_kinetic", "energy_spring", "energy_rendered",
        "energy_push", "energy_hand", "energy_damped", "energy_friction", "energy_moved"})
    EXPECT_TRUE(result.has(std::string("/methods/certified/loop/") + name)) << name;
  EXPECT_TRUE(result.has("/methods/certified/path/position"));
  EXPECT_FALSE(result.has("/methods/certified/loop/held_torque"));
  const std::filesystem::path turned = scratch / "turned.h5";
  run_experiment_to_file(lever(), turned, {"lmdbench", "run"});
  const OpenResult six(turned);
  for (const char* const name : {"held_torque", "angular_velocity", "torque_clipped", "energy_rendered"})
    EXPECT_TRUE(six.has(std::string("/methods/certified/loop/") + name)) << name;
}

}  // namespace
}  // namespace lmdbench
