// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/metrics/times.h>

#include <gtest/gtest.h>

#include <cmath>

namespace lmdbench {
namespace {

/// Six frames, searches at 0, 2 and 4; a warm-up that counts in no number, then three repetitions.
class TimesTest : public ::testing::Test {
 protected:
  TimesTest() {
    record_.frames.resize(6);
    for (const std::int64_t frame : {0, 2, 4}) record_.searches.emplace_back().frame = frame;
    for (const double factor : {1000.0, 1.0, 2.0, 3.0}) {
      RepetitionTimes times;
      for (const double local : {1.0, 2.0, 3.0, 4.0, 5.0, 60.0}) times.local_update.push_back(factor * local);
      for (const double search : {10.0, 20.0, 30.0}) times.global_search.push_back(factor * search);
      times.first_reduction = {factor, UNSET, 3.0 * factor};
      times.second_tracking = {factor, 2.0 * factor, UNSET};
      record_.repetitions.push_back(times);
    }
  }
  MethodSummary summary() const {
    MethodSummary result;
    summarise_times(result, record_, {false, false, true, true, true, false});
    return result;
  }
  MethodRecord record_;
};

TEST_F(TimesTest, StatisticsAreOverFramesInContactAtTheMedianOfTheRepetitions) {
  EXPECT_DOUBLE_EQ(summary().local_update_median_s, 8.0);
  EXPECT_DOUBLE_EQ(summary().local_update_maximum_s, 10.0);
  EXPECT_DOUBLE_EQ(summary().local_update_p99_s, 8.0 + 0.98 * 2.0);
  EXPECT_DOUBLE_EQ(summary().global_search_median_s, 50.0) << "the searches of frames 2 and 4";
  EXPECT_DOUBLE_EQ(summary().global_search_p99_s, 40.0 + 0.99 * 20.0);
  EXPECT_DOUBLE_EQ(summary().first_reduction_median_s, 6.0) << "where there was one";
  EXPECT_DOUBLE_EQ(summary().second_tracking_median_s, 4.0);
  EXPECT_DOUBLE_EQ(summary().search_with_reduction_median_s, (40.0 + 66.0) / 2.0);
}

TEST_F(TimesTest, OneSlowRepetitionSaysNothing) {
  record_.repetitions[3].local_update[3] = 1e6;
  EXPECT_DOUBLE_EQ(summary().local_update_maximum_s, 10.0);
}

TEST_F(TimesTest, TheLastSearchIsNotAllOfTheFrameThatThePathEndsWith) {
  record_.frames.pop_back();
  for (RepetitionTimes& times : record_.repetitions) times.local_update.pop_back();
  EXPECT_DOUBLE_EQ(time_per_frame(record_)[0][4], 5.0 + 16.5) << "as over two frames, like the one before";
  record_.searches.resize(1);
  EXPECT_DOUBLE_EQ(time_per_frame(record_)[0][4], 5.0 + 12.0 / 5.0) << "one alone is over all";
}

TEST_F(TimesTest, ASearchIsSpreadOverTheFramesUntilTheNext) {
  const auto rows = time_per_frame(record_);
  ASSERT_EQ(rows.size(), 3u) << "the warm-up is left out";
  const std::vector<double> expected{1.0 + 6.0, 2.0 + 6.0, 3.0 + 11.0, 4.0 + 11.0, 5.0 + 16.5, 60.0 + 16.5};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(rows[0][i], expected[i]);
  EXPECT_DOUBLE_EQ(summary().frame_time_median_s, 2.0 * 15.0);
  EXPECT_DOUBLE_EQ(summary().frame_time_maximum_s, 2.0 * 21.5);
  EXPECT_EQ(summary().frames_late, 3.0) << "all frames in contact";
  for (RepetitionTimes& times : record_.repetitions) {
    for (double& time : times.local_update) time *= 1e-5;
    times.local_update[3] = 2e-3;
    for (double& time : times.global_search) time = 0.0;
    for (double& time : times.first_reduction) time = 0.0;
    for (double& time : times.second_tracking) time = 0.0;
  }
  EXPECT_EQ(summary().frames_late, 1.0);
  for (RepetitionTimes& times : record_.repetitions) times.local_update[4] = UNSET;
  EXPECT_EQ(summary().frames_late, 2.0) << "a lost frame is not punctual";
}

TEST_F(TimesTest, TheOnlyRepetitionCounts) {
  record_.repetitions.resize(1);
  EXPECT_DOUBLE_EQ(summary().local_update_median_s, 4000.0);
  EXPECT_EQ(time_per_frame(record_).size(), 1u);
}

TEST_F(TimesTest, AMethodWithoutSearchesHasItsFrames) {
  record_.searches.clear();
  for (RepetitionTimes& times : record_.repetitions)
    times.global_search = times.first_reduction = times.second_tracking = {};
  EXPECT_DOUBLE_EQ(summary().frame_time_median_s, summary().local_update_median_s);
  EXPECT_TRUE(std::isnan(summary().global_search_median_s));
}

}  // namespace
}  // namespace lmdbench
