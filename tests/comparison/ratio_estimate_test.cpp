// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/ratio_estimate.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

/// Times of processes around `centre`, log-normal.
std::vector<double> processes(std::mt19937_64& random, std::size_t count, double centre, double spread) {
  std::normal_distribution<double> normal(std::log(centre), spread);
  std::vector<double> values(count);
  for (double& value : values) value = std::exp(normal(random));
  return values;
}

TEST(RatioEstimate, OneProcessASideHasNoInterval) {
  const RatioEstimate estimate = estimate_ratio(std::vector<double>{2.0}, std::vector<double>{3.0}, 0.01);
  EXPECT_DOUBLE_EQ(estimate.ratio, 1.5);
  EXPECT_FALSE(estimate.has_interval());
  EXPECT_FALSE(estimate.can_alarm());
  EXPECT_EQ(estimate.alarm_low, 0.0);
  EXPECT_EQ(estimate.detectable, INFINITY);
}

TEST(RatioEstimate, ASingleProcessHasNoIntervalHoweverManyTheOtherSideHas) {
  const std::vector<double> many(200, 1.0), one{3.0};
  EXPECT_FALSE(estimate_ratio(many, one, 0.01).has_interval()) << "ranks alone would reach 1 in 201";
  EXPECT_FALSE(estimate_ratio(one, many, 0.01).can_alarm());
  EXPECT_TRUE(estimate_ratio(many, std::vector<double>{3.0, 3.1}, 0.01).can_alarm());
}

TEST(RatioEstimate, RatioIsTheMedianOfAllPairings) {
  // Pairings: 2/1, 2/2, 2/4, 6/1, 6/2, 6/4; the median of logarithms is between those of 1.5 and 2.
  const RatioEstimate estimate = estimate_ratio(std::vector<double>{1, 2, 4}, std::vector<double>{2, 6}, 0.1);
  EXPECT_NEAR(estimate.ratio, std::sqrt(1.5 * 2.0), 1e-12);
}

TEST(RatioEstimate, EndsArePairingsThatTheRankTestNames) {
  // 3 x 3: the ends are the extreme pairings at 0.05 (1 order of 20); an alarm at 0.01 needs more.
  const RatioEstimate estimate =
      estimate_ratio(std::vector<double>{1, 2, 3}, std::vector<double>{4, 5, 6}, 0.01);
  EXPECT_NEAR(estimate.low, 4.0 / 3.0, 1e-12);
  EXPECT_NEAR(estimate.high, 6.0 / 1.0, 1e-12);
  EXPECT_TRUE(estimate.has_interval());
  EXPECT_FALSE(estimate.can_alarm());
  const RatioEstimate alarmed =
      estimate_ratio(std::vector<double>{1, 2, 3}, std::vector<double>{4, 5, 6}, 0.05);
  EXPECT_NEAR(alarmed.alarm_low, 4.0 / 3.0, 1e-12);
  EXPECT_NEAR(alarmed.detectable, std::max(alarmed.ratio * 3.0 / 4.0, 6.0 / alarmed.ratio) - 1.0, 1e-12);
}

TEST(RatioEstimate, AnAlarmsIntervalIsTheWider) {
  std::mt19937_64 random(2);
  const RatioEstimate estimate =
      estimate_ratio(processes(random, 10, 1.0, 0.02), processes(random, 10, 1.05, 0.02), 0.001);
  EXPECT_TRUE(estimate.can_alarm());
  EXPECT_LT(estimate.alarm_low, estimate.low);
  EXPECT_GT(estimate.alarm_high, estimate.high);
  EXPECT_LT(estimate.low, estimate.ratio);
  EXPECT_GT(estimate.high, estimate.ratio);
}

TEST(RatioEstimate, AHandfulOfProcessesThatWereHeldUpHidesNothing) {
  // One outlier in ten must not widen the interval, as it widens Student's.
  std::mt19937_64 random(4);
  std::vector<double> base = processes(random, 12, 1.0, 0.005), candidate = processes(random, 10, 1.1, 0.005);
  base[5] *= 1.5;
  candidate[1] *= 3.0;
  const RatioEstimate estimate = estimate_ratio(base, candidate, 0.001);
  EXPECT_GT(estimate.alarm_low, 1.05);
  EXPECT_LT(estimate.high, 1.12);
}

TEST(ProcessesNeeded, ShrinkTheIntervalOfTheRatioSeen) {
  std::mt19937_64 random(3);
  const RatioEstimate estimate =
      estimate_ratio(processes(random, 8, 1.0, 0.04), processes(random, 8, 1.0, 0.04), 0.001);
  const std::size_t needed = processes_needed(estimate, 8, 0.05, 0.001);
  EXPECT_GT(needed, 8U);
  EXPECT_LT(needed, 100U);
  EXPECT_GT(processes_needed(estimate, 8, 0.03, 0.001), needed);
  // With this noise so many processes give a verdict more often than not.
  int ended = 0;
  for (int i = 0; i < 20; ++i) {
    const RatioEstimate more = estimate_ratio(processes(random, needed, 1.0, 0.04),
                                              processes(random, needed, estimate.ratio, 0.04), 0.001);
    ended += (more.low >= 1.0 / 1.05 && more.high <= 1.05) || more.alarm_low > 1.0 || more.alarm_high < 1.0
                 ? 1
                 : 0;
  }
  EXPECT_GT(ended, 8);
}

TEST(ProcessesNeeded, AreEnoughForTheRankTest) {
  const RatioEstimate estimate =
      estimate_ratio(std::vector<double>{1.0, 1.1}, std::vector<double>{1.0, 1.2}, 0.001);
  EXPECT_EQ(processes_needed(estimate, 2, 0.05, 0.001), 7U);  // C(14, 7) = 3432, C(12, 6) = 924
}

}  // namespace
}  // namespace lmdbench
