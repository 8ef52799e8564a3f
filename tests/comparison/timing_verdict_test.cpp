// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/timing_verdict.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

constexpr double LEAST_EFFECT = 0.05;
constexpr double ERROR = 0.001;

std::vector<double> spaced(std::size_t count, double centre, double step) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(centre * (1.0 + step * static_cast<double>(i)));
  return values;
}

Verdict verdict(const std::vector<double>& base, const std::vector<double>& candidate) {
  return judge_timing(base, candidate, LEAST_EFFECT, ERROR).verdict;
}

TEST(TimingVerdict, OneProcessASide) {
  EXPECT_EQ(verdict({1.0}, {1.0}), Verdict::SAME);
  EXPECT_EQ(verdict({1.0}, {1.049}), Verdict::SAME);
  EXPECT_EQ(verdict({1.049}, {1.0}), Verdict::SAME);
  EXPECT_EQ(verdict({1.0}, {1.3}), Verdict::UNSURE);
  EXPECT_EQ(verdict({1.3}, {1.0}), Verdict::UNSURE);
  EXPECT_EQ(verdict({1.0}, {2.1}), Verdict::SLOWER);
  EXPECT_EQ(verdict({2.1}, {1.0}), Verdict::FASTER);
}

TEST(TimingVerdict, OneProcessShowsNothingOfAStageShorterThanAnInterruption) {
  EXPECT_EQ(verdict({1e-6}, {1e-6}), Verdict::SAME);
  EXPECT_EQ(verdict({1e-6}, {4.9e-4}), Verdict::UNSURE);
  EXPECT_EQ(verdict({4.9e-4}, {1e-6}), Verdict::UNSURE);
  EXPECT_EQ(verdict({1e-6}, {5.1e-4}), Verdict::SLOWER);
  EXPECT_EQ(verdict({1e-6, 1e-6, 1e-6}, {4e-6, 4e-6, 4e-6}), Verdict::SLOWER) << "several processes do";
}

TEST(TimingVerdict, Replicates) {
  const std::vector<double> base = spaced(6, 1.0, 0.002);
  EXPECT_EQ(verdict(base, spaced(6, 1.0, 0.0021)), Verdict::SAME);
  EXPECT_EQ(verdict(base, spaced(6, 1.02, 0.002)), Verdict::SAME)
      << "surely slower, but by less than the least effect";
  EXPECT_EQ(verdict(base, spaced(6, 1.10, 0.002)), Verdict::SLOWER);
  EXPECT_EQ(verdict(spaced(6, 1.10, 0.002), base), Verdict::FASTER);
}

TEST(TimingVerdict, NoiseMakesUnsureAndSaysHowManyProcessesWouldDo) {
  const std::vector<double> base = spaced(4, 1.0, 0.05);
  const Timing timing = judge_timing(base, spaced(4, 1.02, 0.05), LEAST_EFFECT, ERROR);
  EXPECT_EQ(timing.verdict, Verdict::UNSURE);
  ASSERT_TRUE(timing.processes_needed.has_value());
  EXPECT_GT(*timing.processes_needed, 4U);
}

TEST(TimingVerdict, AFewSeparatedProcessesDoNotNeedAnUnreachableProbability) {
  const Timing timing = judge_timing(spaced(3, 1.0, 0.002), spaced(3, 1.3, 0.002), LEAST_EFFECT, ERROR);
  EXPECT_GT(timing.ranks.p_larger, ERROR);  // 1 in 20 at best
  EXPECT_EQ(timing.verdict, Verdict::SLOWER);
}

TEST(TimingVerdict, ContradictingPairingsOfFewProcessesAreNotSlower) {
  // Five clean processes are 30 % slower, one is faster than every base process: the ranks do not agree.
  std::vector<double> candidate = spaced(6, 1.30, 0.002);
  candidate.front() = 0.9;
  EXPECT_NE(verdict(spaced(6, 1.0, 0.002), candidate), Verdict::SLOWER);
}

TEST(TimingVerdict, ADetectableEffectIsSlowerOrUnsureButNeverSame) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> noise(0.0, 0.01);
  int slower = 0;
  for (int i = 0; i < 100; ++i) {
    std::vector<double> base(8), candidate(8);
    for (double& value : base) value = std::exp(noise(random));
    for (double& value : candidate) value = 1.10 * std::exp(noise(random));
    const Verdict found = verdict(base, candidate);
    EXPECT_NE(found, Verdict::SAME);
    slower += found == Verdict::SLOWER ? 1 : 0;
  }
  EXPECT_GE(slower, 95);
}

TEST(TimingVerdict, SameProgramIsSeldomSlower) {
  std::mt19937_64 random(9);
  for (const double spread : {0.005, 0.02, 0.1}) {
    std::student_t_distribution<double> noise(
        3.0);  // far heavier tails than the normal that the interval assumes
    int slower = 0;
    for (int i = 0; i < 300; ++i) {
      std::vector<double> base(5), candidate(5);
      for (double& value : base) value = std::exp(spread * noise(random));
      for (double& value : candidate) value = std::exp(spread * noise(random));
      slower += verdict(base, candidate) == Verdict::SLOWER ? 1 : 0;
    }
    EXPECT_LE(slower, 2) << spread;
  }
}

}  // namespace
}  // namespace lmdbench
