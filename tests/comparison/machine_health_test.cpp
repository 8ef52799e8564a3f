// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/machine_health.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

const MachineFacts QUIET{{"frequency_governor", "performance"},
                         {"frequency_boost", "off"},
                         {"load_average_1_minute", "0.10"},
                         {"logical_processors", "4"},
                         {"virtual_machine", "no"},
                         {"stolen_share", "0.0000"},
                         {"smt_siblings", "none"},
                         {"cpu_quota", "none"},
                         {"hardware_counters", "yes"},
                         {"address_space_randomisation", "off"},
                         {"clock_source", "tsc"}};

Health health_of(const MachineFacts& facts, const std::string& name) {
  for (const HealthFinding& finding : judge_machine(facts))
    if (finding.name == name) return finding.health;
  throw std::invalid_argument("no finding " + name);
}

Health with(const std::string& key, const std::string& value, const std::string& name) {
  MachineFacts facts = QUIET;
  facts[key] = value;
  return health_of(facts, name);
}

TEST(MachineHealth, AQuietMachineHasNothingToRemedy) {
  const std::vector<HealthFinding> findings = judge_machine(QUIET);
  EXPECT_EQ(findings.size(), QUIET.size() - 1);  // the number of processors is no finding
  for (const HealthFinding& finding : findings) {
    EXPECT_EQ(finding.health, Health::GOOD) << finding.name;
    EXPECT_THAT(finding.remedy, IsEmpty()) << finding.name;
  }
}

TEST(MachineHealth, EveryUnknownFactIsSaidSo) {
  for (const HealthFinding& finding : judge_machine({})) {
    EXPECT_EQ(finding.health, Health::UNKNOWN) << finding.name;
    EXPECT_THAT(finding.remedy, Not(IsEmpty())) << finding.name;
  }
}

TEST(MachineHealth, WhatMakesTimingsUnreliable) {
  EXPECT_EQ(with("frequency_governor", "powersave, performance", "frequency governor"), Health::BAD);
  EXPECT_EQ(with("frequency_boost", "on", "frequency boost"), Health::BAD);
  EXPECT_EQ(with("load_average_1_minute", "1.99", "load"), Health::GOOD);
  EXPECT_EQ(with("load_average_1_minute", "2.01", "load"), Health::BAD);
  EXPECT_EQ(with("virtual_machine", "yes", "virtual machine"), Health::BAD);
  EXPECT_EQ(with("stolen_share", "0.0123", "stolen time"), Health::BAD);
  EXPECT_EQ(with("smt_siblings", "0,4; 1,5", "SMT sibling"), Health::BAD);
  EXPECT_EQ(with("cpu_quota", "200000 100000", "processor quota"), Health::BAD);
  EXPECT_EQ(with("hardware_counters", "No such file or directory", "hardware counters"), Health::BAD);
  EXPECT_EQ(with("address_space_randomisation", "on", "address randomisation"), Health::BAD);
  EXPECT_EQ(with("clock_source", "hpet", "clock"), Health::BAD);
}

TEST(MachineHealth, FactsOfThisMachineCoverEveryFinding) {
  const MachineFacts facts = machine_facts();
  for (const auto& [name, value] : QUIET) EXPECT_TRUE(facts.contains(name)) << name;
}

TEST(NoiseFloor, SpreadIsOfSumsOfMinima) {
  // Two groups of two repetitions of two pieces; minima 1 + 2 and 1 + 3.
  const std::vector<double> times{1, 9, 8, 2, 5, 3, 1, 7};
  const NoiseFloor floor = summarise_noise(times, 2, 2);
  EXPECT_DOUBLE_EQ(floor.piece_seconds, 1.0);
  EXPECT_DOUBLE_EQ(floor.typical_excess, 3.0);
  EXPECT_NEAR(floor.spread, std::log(4.0 / 3.0) / std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(std::isnan(floor.detectable)) << "two groups are not two sides";
}

TEST(NoiseFloor, DetectableIsWhatACompareWouldSay) {
  // 24 groups of one piece: both sides alternate between 1 and 1.1 in the first 12, then are 2.
  std::vector<double> times;
  for (int i = 0; i < 12; ++i) times.push_back(i % 4 < 2 ? 1.0 : 1.1);
  times.insert(times.end(), 12, 2.0);
  const NoiseFloor floor = summarise_noise(times, 1, 1);
  EXPECT_EQ(floor.processes, 6U);
  EXPECT_NEAR(floor.detectable, 0.05, 1e-9) << "median of 10 % and none";
}

TEST(NoiseFloor, IsMeasuredInAboutTheTimeAskedFor) {
  const NoiseFloor floor = measure_noise_floor(0.3);
  EXPECT_GT(floor.seconds, 0.05);
  EXPECT_LT(floor.seconds, 10.0);
  EXPECT_GT(floor.piece_seconds, 0.0);
  EXPECT_GE(floor.slow_excess, floor.typical_excess);
  EXPECT_GT(floor.spread, 0.0);
}

}  // namespace
}  // namespace lmdbench
