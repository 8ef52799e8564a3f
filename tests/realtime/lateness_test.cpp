// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/realtime/lateness.h>
#include <lmdbench/result/write_result.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace lmdbench {
namespace {

/// n samples, exponential with the given mean.
std::vector<double> exponential(std::size_t n, double mean, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i)
    values.push_back(-mean * std::log(1.0 - 0x1.0p-53 * static_cast<double>(random() >> 11)));
  return values;
}

TEST(Lateness, QuantilesAreSamplesAndSayHowManyLieAbove) {
  std::vector<double> values(1000);
  std::iota(values.begin(), values.end(), 1.0);
  const std::vector<LatenessQuantile> quantiles = Lateness(values).quantiles();
  EXPECT_EQ(quantiles[0].value, 500.0);
  EXPECT_EQ(quantiles[2].value, 990.0);
  EXPECT_EQ(quantiles[2].above, 10);
  EXPECT_EQ(quantiles[4].value, 1000.0);
  EXPECT_EQ(quantiles[4].above, 0);
}

TEST(Lateness, NinetyFiveOfAHundredIntervalsHoldTheTrueQuantile) {
  // p99 of an exponential law is mean * ln 100.
  int holds = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const LatenessQuantile p99 = Lateness(exponential(5000, 1.0, seed)).quantiles()[2];
    EXPECT_LE(p99.low, p99.value);
    EXPECT_LE(p99.value, p99.high);
    holds += p99.low <= std::log(100.0) && std::log(100.0) <= p99.high ? 1 : 0;
  }
  EXPECT_GE(holds, 33);
}

TEST(Lateness, BurstsWidenTheInterval) {
  // Equal samples, the largest scattered or all together: then their frequency is uncertain.
  std::vector<double> scattered(20000, 1.0), together(20000, 1.0);
  for (std::size_t i = 0; i < 400; ++i) {
    scattered[i * 50] = 10.0;
    together[5000 + i] = 10.0;
  }
  const LatenessQuantile alone = Lateness(scattered).quantiles()[2],
                         burst = Lateness(together).quantiles()[2];
  EXPECT_EQ(alone.low, 10.0);
  EXPECT_EQ(burst.low, 1.0);
  EXPECT_EQ(burst.high, 10.0);
}

TEST(Lateness, ExcessIsADifferenceWithAnInterval) {
  const std::vector<double> floor = exponential(20000, 1.0, 1);
  std::vector<double> loop = exponential(20000, 1.0, 2);
  for (double& value : loop) value += 0.5;
  const LatenessExcess p50 = Lateness(loop).excess_over(Lateness(floor))[0];
  EXPECT_NEAR(p50.value, 0.5, 0.05);
  EXPECT_LT(p50.low, 0.5);
  EXPECT_GT(p50.high, 0.5);
  const LatenessExcess itself = Lateness(floor).excess_over(Lateness(floor))[2];
  EXPECT_EQ(itself.value, 0.0);
  EXPECT_LT(itself.low, 0.0);
  EXPECT_GT(itself.high, 0.0) << "a loop compared with itself is not without doubt";
}

TEST(Lateness, InstantsThatALateTickSkippedHaveWaitedForIt) {
  constexpr std::int64_t US = 1000, MS = 1'000'000;
  RealtimeRecord clock;
  clock.period = MS;
  RoleRecord& servo = clock.roles.emplace_back();
  servo.name = "servo";
  servo.times = {{0, MS, 11 * MS}, {10 * US, 10 * MS + 500 * US, 11 * MS}, {20 * US, 11 * MS, 11 * MS}, 9};
  const auto lateness = realtime_json({clock}).at(0)["lateness"];
  // Twelve instants: at 0, from 1 to 10 ms, all served at 10.5 ms, and at 11 ms.
  EXPECT_NEAR(lateness["servo"][0]["value_s"].get<double>(), 3.5e-3, 1e-12) << "the sixth";
  EXPECT_NEAR(lateness["servo"][2]["value_s"].get<double>(), 9.5e-3, 1e-12);
  EXPECT_NEAR(lateness["response"][2]["value_s"].get<double>(), 10e-3, 1e-12);
}

TEST(Lateness, WarningsTellWhatTheClockLacked) {
  RealtimeRecord clock;
  clock.label = "certified";
  clock.roles.emplace_back();
  EXPECT_TRUE(realtime_warnings(clock).empty());
  clock.grants = {{"servo", "locked memory", false, "no right"}, {"servo", "core 1", true, ""}};
  clock.frame_source = {FrameSource::TICK, FrameSource::SKIPPED, FrameSource::LOST, FrameSource::LOST};
  clock.lmd_lists_lost = 3;
  const std::vector<std::string> warnings = realtime_warnings(clock);
  ASSERT_EQ(warnings.size(), 4u);
  EXPECT_EQ(warnings[0], "certified: servo: locked memory was refused: no right");
  EXPECT_TRUE(warnings[1].starts_with("certified: 1 frames without a tick"));
  EXPECT_TRUE(warnings[2].starts_with("certified: 2 frames lost"));
  EXPECT_TRUE(warnings[3].starts_with("certified: 3 LMD lists lost"));
}

TEST(Lateness, NothingIsKnownOfNoSamples) {
  const Lateness nothing({});
  EXPECT_TRUE(std::isnan(nothing.maximum()));
  EXPECT_TRUE(std::isnan(nothing.quantiles()[2].value));
  EXPECT_TRUE(std::isnan(nothing.excess_over(nothing)[2].value));
}

TEST(LatenessHistogram, CountsEverySampleOnce) {
  const std::vector<double> edges = lateness_edges();
  const std::vector<std::int64_t> counts =
      lateness_histogram(std::vector<double>{0.0, 1e-6, 1.01e-6, 5e-5, 0.999, 2.0});
  ASSERT_EQ(counts.size(), edges.size() + 1);
  EXPECT_EQ(counts.front(), 2) << "at or below 1 us";
  EXPECT_EQ(counts[1], 1);
  EXPECT_EQ(counts.back(), 1) << "above a second";
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}), 6);
}

}  // namespace
}  // namespace lmdbench
