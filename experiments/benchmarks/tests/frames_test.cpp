// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/drivers/lockstep.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/phantom/device.h>

#include <benchmarks/local_tracking/implementation.h>
#include <benchmarks/whole_frame/implementation.h>
#include <benchmarks/whole_frame/rendered.h>
#include <gtest/gtest.h>
#include <support/tests/shapes_setting.h>

#include <string>

namespace lmdbench::experiments {
namespace {

constexpr std::size_t FRAME_COUNT = 40;

/// The small ball turns slowly about its centre, over the large one.
RecordedPath turning_path() {
  const Setting setting = shapes_setting(0.3, 1);
  ForceProfile profile;
  profile.law = ForceLaw::EXPONENTIAL;
  profile.cutoff = setting.scene.cutoff;
  profile.maximum_force = 1.0;
  profile.sharpness = 4.0;
  DriverInput input{.poses = {},
                    .frame_rate_hz = 1000.0,
                    .reference_M = Vec3(0.1, 0.0, 0.0),
                    .device = VirtualPhantom(device_named("phantom-desktop", "", "")),
                    .keep_lmds = {}};
  for (std::size_t i = 0; i < FRAME_COUNT; ++i) {
    Pose pose = setting.poses[0];
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.0004 * static_cast<double>(i), Vec3::UnitX()));
    pose.rotation = (turn * pose.rotation).normalized();
    input.poses.push_back(pose);
  }
  std::vector<DrivenMethod> methods;
  for (const std::string& name : method_names())
    methods.push_back({name, [name, scene = setting.scene] { return make_method(name, scene); }, profile});
  RecordedPath path{
      .name = "turn",
      .scene = setting.scene,
      .input = std::move(input),
      .driver = {.search_every_frames = 10, .search_latency_frames = 7, .repetitions = 1, .block_frames = 40},
      .methods = std::move(methods),
      .profile = profile};
  find_truth(path, 7);
  return path;
}

TEST(Frames, KeepTheirPromises) {
  const RecordedPath path = turning_path();
  ASSERT_EQ(path.checked.size(), 6U);
  ASSERT_GE(path.truth[0].size(), 1U);
  for (const auto& implementations : {tracking_implementations(), frame_implementations()})
    for (const FrameImplementation& implementation : implementations) {
      const auto loop = implementation.make(path);
      EXPECT_EQ(check_frames(implementation, *loop, path).objection, "") << implementation.name;
      EXPECT_EQ(check_frames(implementation, *loop, path).objection, "") << implementation.name << " again";
    }
}

TEST(Frames, AreChecked) {
  RecordedPath path = turning_path();
  for (LmdSet& truth : path.truth) truth.pop_back();
  for (const auto& implementation :
       {tracking_implementation("certified"), method_frame("certified"), method_frame("exhaustive")}) {
    const auto loop = implementation.make(path);
    EXPECT_NE(check_frames(implementation, *loop, path).objection, "") << implementation.name;
  }
}

TEST(LocalTracking, FollowsTheTrueSet) {
  const RecordedPath path = turning_path();
  const FrameImplementation improved = tracking_implementation("improved");
  const auto loop = improved.make(path);
  const LmdError error = check_frames(improved, *loop, path);
  EXPECT_EQ(error.minimum_missed, 0U);
  EXPECT_EQ(error.neighbours.recall(), 1.0);
}

TEST(WholeFrame, RendersTheForcesOfTheLockstepDriver) {
  const RecordedPath path = turning_path();
  const std::vector<MethodRecord> records = run_lockstep(path.methods, path.input, path.driver, {});
  for (std::size_t m = 0; m < records.size(); ++m) {
    const auto loop = method_frame(records[m].label).make(path);
    bool any = false;
    for (std::size_t frame = 0; frame < FRAME_COUNT; ++frame) {
      loop->step(frame);
      const Vec3& force = dynamic_cast<const Rendered&>(*loop).force();
      EXPECT_EQ(force, records[m].frames[frame].force) << records[m].label << " frame " << frame;
      any = any || force.norm() > 0.0;
    }
    EXPECT_TRUE(any) << records[m].label;
  }
}

}  // namespace
}  // namespace lmdbench::experiments
