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

TEST(TimingVerdict, OneProcessASideIsUnsureWhateverItTook) {
  for (const double factor : {0.1, 0.49, 1.0, 1.04, 1.95, 8.1, 100.0}) {
    EXPECT_EQ(verdict({1.0}, {factor}), Verdict::UNSURE) << factor;
    EXPECT_EQ(verdict({1e-6}, {factor * 1e-6}), Verdict::UNSURE) << factor;
  }
  EXPECT_EQ(verdict(std::vector<double>(100, 1.0), {8.1}), Verdict::UNSURE) << "one on one side only";
  EXPECT_EQ(
      judge_timing(std::vector<double>{1.0}, std::vector<double>{1.0}, LEAST_EFFECT, ERROR).processes_needed,
      7U);
}

TEST(TimingVerdict, Replicates) {
  const std::vector<double> base = spaced(7, 1.0, 0.002);
  EXPECT_EQ(verdict(base, spaced(7, 1.0, 0.0021)), Verdict::SAME);
  EXPECT_EQ(verdict(base, spaced(7, 1.02, 0.002)), Verdict::SAME)
      << "surely slower, but by less than the least effect";
  EXPECT_EQ(verdict(base, spaced(7, 1.10, 0.002)), Verdict::SLOWER);
  EXPECT_EQ(verdict(spaced(7, 1.10, 0.002), base), Verdict::FASTER);
}

TEST(TimingVerdict, NoiseMakesUnsureAndSaysHowManyProcessesWouldDo) {
  const std::vector<double> base = spaced(4, 1.0, 0.05);
  const Timing timing = judge_timing(base, spaced(4, 1.02, 0.05), LEAST_EFFECT, ERROR);
  EXPECT_EQ(timing.verdict, Verdict::UNSURE);
  ASSERT_TRUE(timing.processes_needed.has_value());
  EXPECT_GT(*timing.processes_needed, 4U);
}

TEST(TimingVerdict, TooFewForARankTestAreUnsure) {
  // 3 x 3: 1 order in 20 at best: enough for an interval (same), not for an alarm (slower).
  const Timing timing = judge_timing(spaced(3, 1.0, 0.002), spaced(3, 4.0, 0.002), LEAST_EFFECT, ERROR);
  EXPECT_EQ(timing.verdict, Verdict::UNSURE);
  EXPECT_EQ(timing.processes_needed, 7U);
  EXPECT_EQ(verdict(spaced(3, 4.0, 0.002), spaced(3, 1.0, 0.002)), Verdict::UNSURE);
  EXPECT_EQ(verdict(spaced(3, 1.0, 0.002), spaced(3, 1.001, 0.002)), Verdict::SAME);
  EXPECT_EQ(verdict(spaced(2, 1.0, 0.002), spaced(2, 1.001, 0.002)), Verdict::UNSURE);
}

TEST(TimingVerdict, SlowerNeedsTheAlarmsIntervalAboveOne) {
  // 7 x 7 at 0.001: bound 2 (of 3432 orders 1 + 1 + 2 + ... <= 3.4): the third smallest decides.
  std::vector<double> base = spaced(7, 1.0, 0.001), candidate = spaced(7, 1.2, 0.001);
  EXPECT_EQ(verdict(base, candidate), Verdict::SLOWER);
  candidate[0] = 0.5 * (base[5] + base[6]);  // one pairing of 49 says faster
  EXPECT_EQ(verdict(base, candidate), Verdict::SLOWER);
  candidate[0] = 0.5 * (base[4] + base[5]);  // two
  EXPECT_EQ(verdict(base, candidate), Verdict::UNSURE);
}

TEST(TimingVerdict, FasterNeedsItBelowOne) {
  std::vector<double> base = spaced(7, 1.2, 0.001), candidate = spaced(7, 1.0, 0.001);
  EXPECT_EQ(verdict(base, candidate), Verdict::FASTER);
  base[0] = 0.5 * (candidate[4] + candidate[5]);
  EXPECT_EQ(verdict(base, candidate), Verdict::UNSURE);
}

TEST(TimingVerdict, OneProcessThatWasHeldUpChangesNoVerdict) {
  std::vector<double> base = spaced(12, 1.0, 0.0005);
  base[4] = 1.4;
  std::vector<double> same = spaced(8, 1.002, 0.0005), slower = spaced(8, 1.1, 0.0005);
  same[2] = slower[2] = 1.9;
  EXPECT_EQ(verdict(base, same), Verdict::SAME);
  EXPECT_EQ(verdict(base, slower), Verdict::SLOWER);
  EXPECT_EQ(verdict(slower, base), Verdict::FASTER);
}

TEST(TimingVerdict, AnIntervalThatReachesBeyondTheLeastEffectIsNotSame) {
  // 5 x 5 at 0.05: bound 5, so the fifth largest pairing is the upper end.
  std::vector<double> base(7, 1.0), candidate(7, 1.0);
  for (std::size_t i = 0; i < 7; ++i) candidate[i] = base[i] = 1.0 + 0.0001 * static_cast<double>(i);
  EXPECT_EQ(verdict(base, candidate), Verdict::SAME);
  candidate[4] = candidate[5] = candidate[6] = 1.06;
  EXPECT_EQ(verdict(base, candidate), Verdict::UNSURE);
  EXPECT_EQ(verdict(candidate, base), Verdict::UNSURE);
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
    std::student_t_distribution<double> noise(3.0);
    int slower = 0;
    for (int i = 0; i < 300; ++i) {
      std::vector<double> base(8), candidate(8);
      for (double& value : base) value = std::exp(spread * noise(random));
      for (double& value : candidate) value = std::exp(spread * noise(random));
      slower += verdict(base, candidate) == Verdict::SLOWER ? 1 : 0;
    }
    EXPECT_LE(slower, 2) << spread;
  }
}

}  // namespace
}  // namespace lmdbench
