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

TEST(RatioEstimate, OneProcessASideShowsAFactorOfTwoOnly) {
  const RatioEstimate estimate = estimate_ratio(std::vector<double>{2.0}, std::vector<double>{3.0}, 0.01);
  EXPECT_DOUBLE_EQ(estimate.ratio, 1.5);
  EXPECT_DOUBLE_EQ(estimate.low, 0.75);
  EXPECT_DOUBLE_EQ(estimate.high, 3.0);
  EXPECT_DOUBLE_EQ(estimate.detectable, 1.0);
  EXPECT_FALSE(estimate.spread.has_value());
}

TEST(RatioEstimate, RatioIsTheMedianOfAllPairings) {
  // Pairings: 2/1, 2/2, 2/4, 6/1, 6/2, 6/4; medians of the logarithms lie between 1.5 and 2.
  const RatioEstimate estimate = estimate_ratio(std::vector<double>{1, 2, 4}, std::vector<double>{2, 6}, 0.1);
  EXPECT_NEAR(estimate.ratio, std::sqrt(1.5 * 2.0), 1e-12);
}

TEST(RatioEstimate, NotNarrowerThanStudentsInterval) {
  // Logarithms 0, 0.1 and 0.2, 0.3: pooled spread sqrt(0.005), t(0.025, 2) = 4.30265.
  const std::vector<double> base{1.0, std::exp(0.1)}, candidate{std::exp(0.2), std::exp(0.3)};
  const RatioEstimate estimate = estimate_ratio(base, candidate, 0.025);
  EXPECT_NEAR(*estimate.spread, std::sqrt(0.005), 1e-12);
  const double half_width = 4.302653 * std::sqrt(0.005);
  EXPECT_NEAR(std::log(estimate.low), 0.2 - half_width, 1e-5);
  EXPECT_NEAR(std::log(estimate.high), 0.2 + half_width, 1e-5);
  EXPECT_NEAR(estimate.detectable, std::exp(half_width) - 1.0, 1e-5);
}

TEST(RatioEstimate, NotNarrowerThanTheBootstrapWhereTimesAreSkewed) {
  // One of eight candidate processes is ten times slower; resamples that draw it often move the median upwards.
  std::vector<double> base(8, 1.0), candidate(8, 1.0);
  for (std::size_t i = 0; i < 8; ++i) base[i] += 0.001 * static_cast<double>(i);
  candidate = base;
  candidate[5] = candidate[6] = candidate[7] = 10.0;
  const RatioEstimate estimate = estimate_ratio(base, candidate, 0.01);
  EXPECT_GT(estimate.high, 9.0);
}

TEST(RatioEstimate, SameSamplesGiveTheSameBits) {
  std::mt19937_64 random(1);
  const std::vector<double> base = processes(random, 7, 1.0, 0.05),
                            candidate = processes(random, 6, 1.1, 0.05);
  const RatioEstimate a = estimate_ratio(base, candidate, 0.01), b = estimate_ratio(base, candidate, 0.01);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
}

TEST(RatioEstimate, CoversTheTruthAsOftenAsPromised) {
  constexpr double ERROR = 0.05, TRUE_RATIO = 1.1;
  constexpr int TRIALS = 400;
  for (const std::size_t count : {2, 3, 5, 10}) {
    std::mt19937_64 random(count);
    int below = 0, above = 0;
    for (int i = 0; i < TRIALS; ++i) {
      const std::vector<double> base = processes(random, count, 1.0, 0.02);
      const std::vector<double> candidate = processes(random, count, TRUE_RATIO, 0.02);
      const RatioEstimate estimate = estimate_ratio(base, candidate, ERROR);
      below += TRUE_RATIO < estimate.low ? 1 : 0;
      above += TRUE_RATIO > estimate.high ? 1 : 0;
    }
    // 5 % of 400 is 20; 35 is more than three standard deviations beyond.
    EXPECT_LT(below, 35) << count;
    EXPECT_LT(above, 35) << count;
    EXPECT_GT(below + above, 0) << count << ": an interval that is never wrong is too wide";
  }
}

TEST(RatioEstimate, ProcessesNeededMakeTheEffectDetectable) {
  const std::size_t needed = processes_needed(0.02, 0.05, 0.001);
  std::mt19937_64 random(3);
  double mean_detectable = 0.0;
  for (int i = 0; i < 20; ++i)
    mean_detectable +=
        estimate_ratio(processes(random, needed, 1.0, 0.02), processes(random, needed, 1.0, 0.02), 0.001)
            .detectable /
        20.0;
  EXPECT_GT(mean_detectable, 0.035);
  EXPECT_LT(mean_detectable, 0.055);
  EXPECT_LT(needed, processes_needed(0.02, 0.02, 0.001));
  EXPECT_LT(needed, processes_needed(0.05, 0.05, 0.001));
}

}  // namespace
}  // namespace lmdbench
