// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/ratio_estimate.h>

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

/// P(U <= u) by its definition: the share of all assignments of the pooled ranks to the sides.
double probability(std::size_t base, std::size_t candidate, std::size_t u) {
  double all = 0.0, found = 0.0;
  for (unsigned mask = 0; mask < 1U << (base + candidate); ++mask) {
    if (static_cast<std::size_t>(std::popcount(mask)) != candidate) continue;
    std::size_t pairs = 0;  // a base value before a candidate's
    for (std::size_t c = 0; c < base + candidate; ++c)
      for (std::size_t b = 0; b < c; ++b) pairs += ((mask >> c) & 1U) != 0 && ((mask >> b) & 1U) == 0 ? 1 : 0;
    all += 1.0;
    found += pairs <= u ? 1.0 : 0.0;
  }
  return found / all;
}

TEST(RankBound, IsTheLargestThatKeepsTheError) {
  for (std::size_t base = 1; base <= 6; ++base) {
    for (std::size_t candidate = 1; candidate <= 6; ++candidate) {
      for (const double error : {0.001, 0.01, 0.05, 0.2}) {
        const std::size_t bound = rank_bound(base, candidate, error);
        if (bound > 0) {
          EXPECT_LE(probability(base, candidate, bound - 1), error) << base << " " << candidate;
        }
        if (2 * (bound + 1) <= base * candidate) {
          EXPECT_GT(probability(base, candidate, bound), error) << base << " " << candidate << " " << error;
        }
      }
    }
  }
}

TEST(RankBound, PublishedTable) {
  // Critical values of U, one-sided 0.025 (Mann and Whitney 1947, and later tables).
  EXPECT_EQ(rank_bound(8, 8, 0.025), 13U + 1U);
  EXPECT_EQ(rank_bound(5, 9, 0.025), 7U + 1U);
  EXPECT_EQ(rank_bound(20, 20, 0.025), 127U + 1U);
  EXPECT_EQ(rank_bound(12, 6, 0.05), 17U + 1U);
  EXPECT_EQ(rank_bound(3, 3, 0.025), 0U) << "1 of 20 orders is too likely";
  EXPECT_EQ(rank_bound(9, 5, 0.025), rank_bound(5, 9, 0.025));
}

TEST(RankBound, ManyProcesses) {
  // Normal approximation with continuity: mean 5000, deviation 408.9; z(0.001) = 3.090.
  EXPECT_NEAR(static_cast<double>(rank_bound(100, 100, 0.001)), 5000.0 - 3.090 * 409.3 + 0.5, 8.0);
}

TEST(Pairings, AreAllDifferencesInOrder) {
  const std::vector<double> base{1.0, 2.0, 4.0}, candidate{6.0, 2.0};
  const Pairings pairings(base, candidate);  // -2 0 1 2 4 5
  EXPECT_EQ(pairings.low(1), -2.0);
  EXPECT_EQ(pairings.high(1), 5.0);
  EXPECT_EQ(pairings.shift(), 1.5);
  EXPECT_EQ(pairings.low(1), -2.0);
  EXPECT_EQ(pairings.low(3), 1.0);
  EXPECT_EQ(pairings.high(1), 5.0);
  EXPECT_EQ(pairings.high(2), 4.0);
}

TEST(Pairings, IntervalMissesTheShiftAsOftenAsTheBoundSays) {
  // Heavy tails and a few delayed processes: only the order counts. With continuous values the
  // share is exact: 12 x 6 at 0.05 misses in P(U <= 17).
  constexpr int TRIALS = 4000;
  const std::size_t bound = rank_bound(12, 6, 0.05);
  std::mt19937_64 random(7);
  std::student_t_distribution<double> noise(2.0);
  int below = 0, above = 0;
  for (int i = 0; i < TRIALS; ++i) {
    std::vector<double> base(12), candidate(6);
    for (double& value : base) value = noise(random) + (random() % 8 == 0 ? 30.0 : 0.0);
    for (double& value : candidate) value = 5.0 + noise(random) + (random() % 8 == 0 ? 30.0 : 0.0);
    const Pairings pairings(base, candidate);
    below += 5.0 < pairings.low(bound) ? 1 : 0;
    above += 5.0 > pairings.high(bound) ? 1 : 0;
  }
  // P(U <= 17) = 0.0494 (18,564 orders); three standard deviations of 4,000 trials are 0.0103.
  EXPECT_NEAR(below / static_cast<double>(TRIALS), 0.047, 0.0115);
  EXPECT_NEAR(above / static_cast<double>(TRIALS), 0.047, 0.0115);
}

TEST(Pairings, OneProcessThatWasHeldUpDoesNotWidenTheInterval) {
  std::vector<double> base, candidate;
  for (int i = 0; i < 12; ++i) base.push_back(0.001 * i);
  for (int i = 0; i < 8; ++i) candidate.push_back(0.0015 * i);
  const std::size_t bound = rank_bound(12, 8, 0.05);
  base[3] = candidate[2] = 9.0;
  const Pairings pairings(base, candidate);
  EXPECT_GT(pairings.low(bound), -0.012);
  EXPECT_LT(pairings.high(bound), 0.012);
}

}  // namespace
}  // namespace lmdbench
