// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/errors.h>

#include <gtest/gtest.h>

#include <cmath>

namespace lmdbench {
namespace {

constexpr double RATE_HZ = 100.0, MAXIMUM_FORCE = 2.0;
constexpr double JUMP = JUMP_SHARE * MAXIMUM_FORCE;

FrameRecord frame_of(double force, std::int64_t lmds = 0) {
  FrameRecord frame;
  frame.force = Vec3(force, 0.0, 0.0);
  frame.lmd_count = lmds;
  return frame;
}

SearchRecord search_of(std::int64_t frame, std::int64_t candidates, std::int64_t kept) {
  SearchRecord search;
  search.frame = frame;
  search.candidates = candidates;
  search.kept_after_reduction = kept;
  return search;
}

TEST(SummariseCounts, CountsLmdsOfTheFramesInContact) {
  MethodRecord record;
  for (const std::int64_t lmds : {9, 1, 0, 4, 2}) record.frames.push_back(frame_of(0.0, lmds));
  record.frames[3].minimum_distance = 0.0;
  MethodSummary summary;
  summarise_counts(summary, record, {{false, true, true, true, true}, RATE_HZ, MAXIMUM_FORCE});
  EXPECT_DOUBLE_EQ(summary.lmd_count_median, 1.5) << "an empty set in contact counts, free flight does not";
  EXPECT_DOUBLE_EQ(summary.lmd_count_p99, 2.0 + 0.97 * 2.0);
  EXPECT_DOUBLE_EQ(summary.lmd_count_maximum, 9.0);
  EXPECT_DOUBLE_EQ(summary.frames_touching, 1.0);
  EXPECT_TRUE(std::isnan(summary.reduction_ratio)) << "no searches";
}

TEST(SummariseCounts, ReductionRatioIsOfSums) {
  MethodRecord record;
  for (int i = 0; i < 4; ++i) record.frames.push_back(frame_of(0.0, 1));
  record.searches = {search_of(0, 30, 1), search_of(1, 10, 5), search_of(2, 0, 0), search_of(3, 8, 2)};
  MethodSummary summary;
  summarise_counts(summary, record, {{false, true, true, true}, RATE_HZ, MAXIMUM_FORCE});
  EXPECT_DOUBLE_EQ(summary.reduction_ratio, 48.0 / 8.0);
  EXPECT_DOUBLE_EQ(summary.reduction_ratio_maximum, 30.0);
  EXPECT_DOUBLE_EQ(summary.candidates_median, 8.0) << "of 10, 0 and 8, in contact";
}

TEST(SummariseJumps, CountsLargeChangesPerSecondInContact) {
  MethodRecord record;
  for (const double force : {0.0, 1.1 * JUMP, 0.2 * JUMP, 0.2 * JUMP, 1.25 * JUMP, 0.0})
    record.frames.push_back(frame_of(force));
  MethodSummary summary;
  summarise_jumps(summary, record, {{false, true, true, true, true, false}, RATE_HZ, MAXIMUM_FORCE});
  EXPECT_EQ(summary.jumps, 3.0);
  EXPECT_TRUE(std::isnan(summary.jumps_per_second)) << "three events have no rate";
  EXPECT_NEAR(summary.jumps_per_second_low, 0.6187 / (4.0 / RATE_HZ), 0.01);
  MethodRecord restless;
  for (int i = 0; i < 11; ++i) restless.frames.push_back(frame_of(i % 2 == 0 ? 0.0 : 1.1 * JUMP));
  summarise_jumps(summary, restless, {std::vector<bool>(11, true), RATE_HZ, MAXIMUM_FORCE});
  EXPECT_DOUBLE_EQ(summary.jumps_per_second, 10.0 / (11.0 / RATE_HZ));
  MethodSummary apart;
  summarise_jumps(apart, record, {std::vector<bool>(6, false), RATE_HZ, MAXIMUM_FORCE});
  EXPECT_TRUE(std::isnan(apart.jumps_per_second));
}

/// Five probed frames: free flight, contact, at rest on each other, intersecting, contact.
class SummariseErrorsTest : public ::testing::Test {
 protected:
  SummariseErrorsTest() {
    const double distances[] = {0.0, 0.01, 0.0, 0.0, 0.03};
    const std::size_t true_counts[] = {0, 1, 4, 1, 1}, reported[] = {1, 0, 4, 1, 2},
                      found[] = {0, 0, 3, 1, 1};
    const double errors[] = {50.0, 3.0, 0.0, 40.0, 4.0}, jumps[] = {60.0, 1.0, 2.0, 5.0, 3.0};
    for (std::size_t i = 0; i < 5; ++i) {
      TruthFrame frame;
      frame.frame = static_cast<std::int64_t>(2 * i);
      frame.lmds.resize(true_counts[i]);
      for (Lmd& lmd : frame.lmds) {
        lmd.distance = distances[i];
        if (i != 3) lmd.direction = Vec3::UnitZ();
      }
      // The frame that intersects has no true force to change from.
      frame.force_jump = {i == 2 || i == 0 ? 1.01 * JUMP : 0.99 * JUMP, 0.1 * static_cast<double>(i)};
      if (i == 3) frame.force_jump = {UNSET, UNSET};
      truth_.push_back(frame);
      TruthComparison row;
      row.same = {true_counts[i], found[i], reported[i], found[i]};
      row.neighbours = {true_counts[i], true_counts[i], reported[i], found[i] + (i == 2 ? 1 : 0)};
      row.force_error = errors[i];
      row.force_angle_error = i == 1 ? UNSET : 0.1 * static_cast<double>(i);
      row.force_jump = jumps[i];
      row.minimum_distance_error = i == 2 ? -0.005 : (i == 4 ? 0.004 : UNSET);
      comparisons_.push_back(row);
    }
    frames_ = {{false, false, true, true, true, true, true, true, true, false}, RATE_HZ, MAXIMUM_FORCE};
    summarise_errors(summary_, ForceLaw::LINEAR, truth_, comparisons_, frames_);
  }

  std::vector<TruthFrame> truth_;
  std::vector<TruthComparison> comparisons_;
  RunFrames frames_;
  MethodSummary summary_;
};

TEST_F(SummariseErrorsTest, RecallAndPrecisionArePooled) {
  EXPECT_DOUBLE_EQ(summary_.recall, 5.0 / 7.0) << "no mean over frames, which is 0.6875";
  EXPECT_DOUBLE_EQ(summary_.precision, 5.0 / 8.0);
  EXPECT_DOUBLE_EQ(summary_.recall_adjacent, 1.0);
  EXPECT_DOUBLE_EQ(summary_.precision_adjacent, 6.0 / 8.0);
  EXPECT_DOUBLE_EQ(summary_.frames_wrong, 4.0) << "all but the one that intersects";
}

TEST_F(SummariseErrorsTest, ForceErrorsAreWhereTheTrueForceIsKnown) {
  EXPECT_DOUBLE_EQ(summary_.force_error_rms_n, std::sqrt((9.0 + 0.0 + 16.0) / 3.0));
  EXPECT_DOUBLE_EQ(summary_.force_error_median_n, 3.0);
  EXPECT_DOUBLE_EQ(summary_.force_error_maximum_n, 4.0);
  EXPECT_DOUBLE_EQ(summary_.force_error_p99_n, 3.98);
  EXPECT_DOUBLE_EQ(summary_.force_angle_error_median_rad, 0.3)
      << "of 0.2 and 0.4; one is unset, one intersects";
  EXPECT_DOUBLE_EQ(summary_.minimum_distance_error_maximum_m, 0.005);
}

TEST_F(SummariseErrorsTest, ChangesOfForceAreOverTheSameFramesInContactForBoth) {
  EXPECT_DOUBLE_EQ(summary_.force_jump_maximum_n, 3.0) << "5 is where no true change is known";
  EXPECT_DOUBLE_EQ(summary_.force_jump_p99_n, 2.0 + 0.98 * 1.0);
  EXPECT_DOUBLE_EQ(summary_.true_force_jump_maximum_n, 1.01 * JUMP);
  EXPECT_EQ(summary_.true_jumps, 1.0);
  EXPECT_EQ(summary_.true_jump_frames, 3.0);
  EXPECT_TRUE(std::isnan(summary_.true_jumps_per_second)) << "one event has no rate";
  MethodSummary exponential;
  summarise_errors(exponential, ForceLaw::EXPONENTIAL, truth_, comparisons_, frames_);
  EXPECT_DOUBLE_EQ(exponential.true_force_jump_maximum_n, 0.4) << "of the method's own law";
  EXPECT_EQ(exponential.true_jumps, 0.0);
}

TEST_F(SummariseErrorsTest, TruthOfEveryFrameTakesThePlaceOfTheProbes) {
  CompleteTruth truth{"certified", {}, std::vector<std::int64_t>(10, 1)};
  MethodRecord same, other;
  for (int i = 0; i < 10; ++i) {
    const double force = i % 2 == 0 ? 0.0 : 1.01 * JUMP;
    truth.force[static_cast<std::size_t>(ForceLaw::LINEAR)].push_back(Vec3(force, 0.0, 0.0));
    truth.force[static_cast<std::size_t>(ForceLaw::EXPONENTIAL)].push_back(Vec3::Zero());
    same.frames.push_back(frame_of(force));
    other.frames.push_back(frame_of(0.0));
  }
  summarise_jumps(summary_, same, frames_);
  summarise_true_steps(summary_, ForceLaw::LINEAR, same, truth, frames_);
  EXPECT_EQ(summary_.true_jumps, 9.0) << "one law, one set: ...";
  EXPECT_EQ(summary_.jumps, 9.0) << "... as many as the method, to the last one";
  EXPECT_EQ(summary_.true_jumps_per_second_low, summary_.jumps_per_second_low);
  EXPECT_EQ(summary_.true_jump_frames, 7.0);
  EXPECT_EQ(summary_.force_jump_maximum_n, summary_.true_force_jump_maximum_n);
  summarise_true_steps(summary_, ForceLaw::EXPONENTIAL, other, truth, frames_);
  EXPECT_EQ(summary_.true_jumps, 0.0) << "of the method's own law";
  EXPECT_EQ(summary_.force_jump_maximum_n, 0.0);
}

/// Truth probed in every frame and truth of a complete method are of the same frames.
TEST_F(SummariseErrorsTest, TheLastFrameCountsInBothRates) {
  frames_.in_contact.assign(10, true);
  CompleteTruth complete{"certified", {}, std::vector<std::int64_t>(10, 1)};
  std::vector<TruthFrame> probed(10);
  MethodRecord record;
  for (int i = 0; i < 10; ++i) {
    for (std::vector<Vec3>& forces : complete.force) forces.emplace_back(Vec3::Zero());
    probed[static_cast<std::size_t>(i)].frame = i;
    if (i == 9) probed[9].force_jump.fill(UNSET);
    record.frames.push_back(frame_of(0.0));
  }
  MethodSummary of_probes, of_all;
  summarise_errors(of_probes, ForceLaw::LINEAR, probed, std::vector<TruthComparison>(10), frames_);
  summarise_true_steps(of_all, ForceLaw::LINEAR, record, complete, frames_);
  EXPECT_EQ(of_probes.true_jump_frames, 10.0);
  EXPECT_EQ(of_all.true_jump_frames, 10.0);
  EXPECT_EQ(of_probes.true_jumps_per_second_high, of_all.true_jumps_per_second_high);
}

TEST_F(SummariseErrorsTest, StepsWithoutATrueForceCountNowhere) {
  CompleteTruth truth{"certified", {}, std::vector<std::int64_t>(10, 1)};
  MethodRecord record;
  for (int i = 0; i < 10; ++i) {
    const double force = i % 2 == 0 ? 0.0 : 1.01 * JUMP;
    truth.force[static_cast<std::size_t>(ForceLaw::LINEAR)].push_back(
        Vec3::Constant(i == 4 ? UNSET : force / std::sqrt(3.0)));
    record.frames.push_back(frame_of(i == 4 ? 50.0 : 0.0));
  }
  summarise_true_steps(summary_, ForceLaw::LINEAR, record, truth, frames_);
  EXPECT_EQ(summary_.true_jump_frames, 5.0) << "of 2 to 8, without 3 and 4";
  EXPECT_EQ(summary_.true_jumps, 7.0) << "also of frames out of contact";
  EXPECT_NEAR(summary_.true_jumps_per_second_low, 2.8144 / (5.0 / RATE_HZ), 0.01);
  EXPECT_EQ(summary_.force_jump_maximum_n, 0.0) << "of the same steps";
}

TEST(SummariseErrors, NothingProbedIsUnset) {
  MethodSummary summary;
  summarise_errors(summary, ForceLaw::LINEAR, {}, {}, {{true}, RATE_HZ, MAXIMUM_FORCE});
  for (const double value : {summary.recall, summary.precision, summary.force_error_rms_n,
                             summary.force_jump_p99_n, summary.true_jumps_per_second})
    EXPECT_TRUE(std::isnan(value));
}

}  // namespace
}  // namespace lmdbench
