// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/comparison/comparison_text.h>

#include "synthetic_result.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/scratch_directory.h>

namespace lmdbench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::SyntheticResult;

std::vector<std::string> keys(const nlohmann::ordered_json& object) {
  std::vector<std::string> names;
  for (const auto& [key, value] : object.items()) names.push_back(key);
  return names;
}

class Reports : public ::testing::Test {
 protected:
  Comparison compare_with(const SyntheticResult& candidate) {
    return compare_results({SyntheticResult{}.write(scratch_ / "a.h5")}, {candidate.write(scratch_ / "b.h5")},
                           {});
  }
  testing::ScratchDirectory scratch_;
};

TEST_F(Reports, JsonHasTheKeysOfTheContract) {
  SyntheticResult candidate;
  candidate.frame_with_lost_lmd = 4;
  const auto json = nlohmann::ordered_json::parse(comparison_json(compare_with(candidate)));
  EXPECT_THAT(keys(json), ElementsAre("verdict", "differences", "timings", "machine", "notes"));
  EXPECT_EQ(json["verdict"], "changed");
  EXPECT_THAT(keys(json["differences"][0]), ElementsAre("method", "dataset", "frame", "base", "candidate"));
  EXPECT_EQ(json["differences"][0]["method"], "certified");
  EXPECT_EQ(json["differences"][0]["dataset"], "lmd_count");
  EXPECT_EQ(json["differences"][0]["frame"], 4);
  EXPECT_THAT(keys(json["timings"][0]), ElementsAre("method", "stage", "ratio", "low", "high", "verdict",
                                                    "detectable", "processes_needed"));
  EXPECT_GT(json["timings"][0]["processes_needed"], 1);
  EXPECT_THAT(json["notes"].back().get<std::string>(), HasSubstr("one process a side"));
  EXPECT_TRUE(json["timings"][0]["low"].is_null()) << "one process a side has no interval";
  EXPECT_TRUE(json["timings"][0]["high"].is_null());
  EXPECT_EQ(json["machine"]["comparable"], true);
  EXPECT_EQ(json["machine"]["base"]["processor"], "processor A");
}

TEST_F(Reports, TextAndMarkdownNameFrameAndValues) {
  SyntheticResult candidate;
  candidate.frame_with_other_force = 7;
  const Comparison comparison = compare_with(candidate);
  EXPECT_THAT(comparison_text(comparison),
              HasSubstr("original: force differs in frame 7: [0.0,-0.5,0.8] became "));
  EXPECT_THAT(comparison_markdown(comparison), HasSubstr("| original | `force` | 7 | [0.0,-0.5,0.8] | "));
  EXPECT_THAT(comparison_markdown(comparison),
              HasSubstr("| original | search | 100 | 100 | 1.000 | unknown | - | unsure |"));
}

TEST_F(Reports, JunitCountsFailures) {
  SyntheticResult candidate;
  candidate.slowdown["original/search"] = 6.0;
  Comparison comparison = compare_with(candidate);
  EXPECT_THAT(comparison_junit(comparison), HasSubstr("tests=\"4\" failures=\"0\" skipped=\"3\""));
  for (Timing& timing : comparison.timings)
    timing.verdict = timing.stage == "search" ? Verdict::SLOWER : Verdict::SAME;
  const std::string xml = comparison_junit(comparison);
  EXPECT_THAT(xml, HasSubstr("tests=\"4\" failures=\"1\" skipped=\"0\""));
  EXPECT_THAT(
      xml, HasSubstr(
               "<testcase classname=\"lmdbench.compare.original\" name=\"search\"><failure type=\"slower\""));
}

TEST_F(Reports, JunitSaysThatNoTimeWasCompared) {
  SyntheticResult cold;
  cold.repetitions = 1;
  cold.warm_up = 0;
  const std::string xml = comparison_junit(compare_with(cold));
  EXPECT_THAT(xml, HasSubstr("tests=\"2\" failures=\"0\" skipped=\"1\""));
  EXPECT_THAT(xml, HasSubstr("name=\"times\"><skipped message=\"no time was compared: "));
}

TEST(DifferenceText, NamesTheElementOfALongRow) {
  const std::vector<double> base(40, 0.25);
  std::vector<double> candidate = base;
  candidate[38] = 0.5;
  EXPECT_EQ(difference_text({"m", "movers/force", 3, base, candidate, 1}),
            "m: movers/force differs in frame 3: element 38: 0.25 became element 38: 0.5");
  std::string accents;
  for (int i = 0; i < 80; ++i) accents += "\u00e9";
  EXPECT_THAT(difference_text({"", "/name", std::nullopt, accents, 1, 0}), HasSubstr("\u00e9... became 1"));
  EXPECT_EQ(difference_text({"", "/loop/hand", std::nullopt, nullptr, 1, 0}),
            "/loop/hand differs: null became 1");
}

TEST_F(Reports, GoogleBenchmarkFormat) {
  const Comparison comparison = compare_with({});
  const auto json = nlohmann::json::parse(google_benchmark_json(comparison.base, comparison.machine.base));
  ASSERT_EQ(json["benchmarks"].size(), 3U);
  const nlohmann::json& search = json["benchmarks"][1];
  EXPECT_EQ(search["name"], "original/search");
  EXPECT_NEAR(search["real_time"].get<double>(), 1e5, 1e-6);  // 2 searches of 50 us, in ns
  EXPECT_EQ(search["time_unit"], "ns");
  EXPECT_TRUE(json["context"].contains("num_cpus"));
}

}  // namespace
}  // namespace lmdbench
