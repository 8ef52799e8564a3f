// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/metrics/step_numbers.h>
#include <lmdbench/phantom/device.h>
#include <lmdbench/probes/truth_probe.h>

#include <gtest/gtest.h>
#include <support/scenes.h>

#include <cmath>

namespace lmdbench {
namespace {

constexpr double CUTOFF = 0.05;

/// Two spheres that approach along x, vertex to vertex. F_max is 2 N, the law linear.
PreparedRun approach(const std::vector<double>& gaps) {
  PreparedRun run{
      .profiles = {{"",
                    {ForceLaw::LINEAR, CUTOFF, 0.0, 2.0, 4.0},
                    testing::make_scene(make_sphere(0.5, 3), make_sphere(0.5, 3), CUTOFF)}},
      .input = {.poses = {}, .device = VirtualPhantom(device_named("phantom-desktop")), .keep_lmds = {}},
      .times = {},
      .meshes = {},
      .files = {},
      .starts_touching = false,
      .warnings = {},
      .path_gaps = {},
      .made_path = std::nullopt,
      .defaults = {}};
  for (const double gap : gaps) {
    run.input.poses.push_back({Vec3(1.0 + gap, 0.0, 0.0)});
  }
  return run;
}

struct Judged {
  StepNumbers numbers;
  TrueSets truth;
};

/// Numbers of a method that has the true sets except in the listed frames, where it has none.
Judged blind_in(const PreparedRun& run, const std::vector<std::size_t>& blind,
                const std::vector<bool>& in_contact) {
  Judged judged;
  judged.truth = true_sets(run, 3, {});
  MethodRecord record;
  for (std::size_t frame = 0; frame < run.input.poses.size(); ++frame) {
    LmdSet set = judged.truth.frames[frame].lmds;
    if (std::find(blind.begin(), blind.end(), frame) != blind.end()) set.clear();
    FrameRecord& row = record.frames.emplace_back();
    row.lmd_count = static_cast<std::int64_t>(set.size());
    for (const Lmd& lmd : set)
      if (!lmd.intersecting) row.force -= 2.0 * (1.0 - lmd.distance / CUTOFF) * lmd.direction;
    record.lmds[static_cast<std::int64_t>(frame)] = set;
  }
  std::vector<TruthFrame> frames = judged.truth.frames;
  frames.pop_back();
  judged.numbers =
      count_steps(record, ForceLaw::LINEAR, frames,
                  compare_with_truth(frames, record, ForceLaw::LINEAR, &run.scene()), run, run, in_contact);
  return judged;
}

TEST(TrueSets, IsTheExhaustiveSetAndSaysWhereItWasChecked) {
  const PreparedRun run = approach({0.04, 0.03, 0.02, 0.06, 0.01, 0.02, 0.03, 0.04, 0.045, 0.04});
  const TrueSets truth = true_sets(run, 5, {});
  ASSERT_EQ(truth.frames.size(), 10u);
  EXPECT_EQ(truth.checked_frames, 5);
  EXPECT_EQ(truth.wrong_frames, 0);
  EXPECT_NEAR(truth.frames[2].lmds.at(0).distance, 0.02, 1e-9);
  EXPECT_TRUE(truth.frames[3].lmds.empty()) << "beyond the cutoff";
  EXPECT_EQ(true_sets(run, 100, {}).checked_frames, 10) << "no more than there are";
  EXPECT_EQ(true_sets(run, 0, {}).checked_frames, 0);
  EXPECT_EQ(truth.frames[4].frame, 4);
  EXPECT_NEAR(truth.frames[4].force[0].x(), 2.0 * 0.8, 1e-6);
  EXPECT_NEAR(truth.frames[4].force_jump[0], 2.0 * 0.2, 1e-6);
}

TEST(StepNumbers, APerfectMethodJumpsWhereTruthDoesAndNowhereElse) {
  // From 0.02 N to 1.6 N is a jump of more than a quarter of F_max; other changes are 0.1 of it.
  const PreparedRun run = approach({0.0495, 0.01, 0.0125, 0.015, 0.0175});
  const StepNumbers numbers = blind_in(run, {}, std::vector<bool>(5, true)).numbers;
  EXPECT_EQ(numbers.jumps, 1.0);
  EXPECT_EQ(numbers.true_jumps, 1.0);
  EXPECT_EQ(numbers.false_jumps, 0.0);
  EXPECT_EQ(numbers.missed_jumps, 0.0);
  EXPECT_EQ(numbers.switches, 1.0) << "below 5 % to above 50 % of F_max";
  EXPECT_EQ(numbers.true_switches, 1.0);
  EXPECT_EQ(numbers.births, 0.0) << "the pair is the same in every frame";
  EXPECT_EQ(numbers.deaths, 0.0);
  EXPECT_EQ(numbers.frames_empty, 0.0);
  EXPECT_NEAR(numbers.force_magnitude_error_rms_n, 0.0, 1e-9);
  EXPECT_NEAR(numbers.force_angle_error_p99_rad, 0.0, 1e-6);
  EXPECT_NEAR(numbers.seconds_in_contact, 0.004, 1e-12) << "the last frame has no next one";
  EXPECT_NEAR(numbers.force_mean_n, numbers.true_force_mean_n, 1e-9);
}

TEST(StepNumbers, AFrameWithoutItsPairIsTwoFalseJumpsADeathAndABirth) {
  const PreparedRun run = approach({0.01, 0.0105, 0.011, 0.0115, 0.012, 0.0125});
  const StepNumbers numbers = blind_in(run, {2}, std::vector<bool>(6, true)).numbers;
  EXPECT_EQ(numbers.jumps, 2.0);
  EXPECT_EQ(numbers.true_jumps, 0.0);
  EXPECT_EQ(numbers.false_jumps, 2.0);
  EXPECT_EQ(numbers.switches, 2.0);
  EXPECT_EQ(numbers.true_switches, 0.0);
  EXPECT_EQ(numbers.births, 1.0);
  EXPECT_EQ(numbers.deaths, 1.0);
  EXPECT_EQ(numbers.true_births + numbers.true_deaths, 0.0);
  EXPECT_EQ(numbers.frames_empty, 1.0);
  EXPECT_NEAR(numbers.lmd_count_mean, 4.0 / 5.0, 1e-12);
  EXPECT_NEAR(numbers.true_lmd_count_mean, 1.0, 1e-12);
  const double lost = 2.0 * (1.0 - 0.011 / CUTOFF);
  EXPECT_NEAR(numbers.force_magnitude_error_rms_n, std::sqrt(lost * lost / 5.0), 1e-6);
}

TEST(StepNumbers, ATrueJumpThatIsNotSeenIsMissed) {
  const PreparedRun run = approach({0.0495, 0.01, 0.0105, 0.011});
  const StepNumbers numbers = blind_in(run, {0, 1, 2, 3}, std::vector<bool>(4, true)).numbers;
  EXPECT_EQ(numbers.true_jumps, 1.0);
  EXPECT_EQ(numbers.missed_jumps, 1.0);
  EXPECT_EQ(numbers.jumps, 0.0);
}

TEST(StepNumbers, JumpsAreThoseOfEveryStepAndTheRestIsInContact) {
  const PreparedRun run = approach({0.01, 0.0105, 0.011, 0.0115, 0.012, 0.0125});
  const StepNumbers numbers = blind_in(run, {2}, {true, false, false, true, true, true}).numbers;
  EXPECT_EQ(numbers.jumps, 2.0) << "as summarise_jumps counts them";
  EXPECT_EQ(numbers.switches, 1.0) << "the step into contact; from 1 to 2 nothing is in contact";
  EXPECT_EQ(numbers.births, 1.0);
  EXPECT_EQ(numbers.deaths, 0.0);
  EXPECT_EQ(blind_in(run, {5}, std::vector<bool>(6, true)).numbers.jumps, 1.0) << "to the last frame";
  EXPECT_EQ(numbers.frames_empty, 0.0);
  EXPECT_NEAR(numbers.seconds_in_contact, 0.003, 1e-12);
}

/// Triangles that intersect have no direction: no change from there or to there is the true one.
TEST(StepNumbers, StepsToFramesThatIntersectAreNotJudged) {
  const PreparedRun run = approach({0.01, 0.0105, -0.01, 0.01, 0.0105, 0.011});
  const StepNumbers numbers = blind_in(run, {}, std::vector<bool>(6, true)).numbers;
  EXPECT_EQ(numbers.jumps, 2.0);
  EXPECT_EQ(numbers.true_jumps + numbers.false_jumps + numbers.missed_jumps, 0.0);
  EXPECT_EQ(numbers.switches, 2.0);
  EXPECT_EQ(numbers.true_switches, 0.0);
  EXPECT_NEAR(numbers.true_force_mean_n, 2.0 * (1.0 - 0.01025 / CUTOFF), 1e-6);
}

}  // namespace
}  // namespace lmdbench
