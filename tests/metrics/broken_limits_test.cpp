// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/metrics/broken_limits.h>
#include <lmdbench/metrics/summary.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>
#include <support/source_directory.h>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Experiment with_limits(const std::string& limits, std::vector<Override> overrides = {}) {
  overrides.push_back("/limits=" + limits);
  return load_experiment(LMDBENCH_SOURCE_DIR "/experiments/shapes.json", overrides);
}

RunSummary summary() {
  RunSummary result;
  for (const char* label : {"original", "improved"}) {
    MethodSummary& method = result.methods.emplace_back();
    method.label = label;
    method.recall = 0.9;
    method.force_error_maximum_n = 0.25;
    method.frames_late = 3;
  }
  result.methods[0].recall = 0.1;
  result.fcl_frames = 100;
  result.fcl_exceptions = {{"original", 5}};
  return result;
}

std::vector<std::string> broken(const std::string& limits) {
  return broken_limits(with_limits(limits).acceptance, summary());
}

TEST(Acceptance, EachLimitIsKeptAtItsBound) {
  EXPECT_THAT(broken(R"({"recall": 0.1, "force_error_n": 0.25, "late_frames": 3, "fcl_disagreements": 5})"),
              IsEmpty());
  EXPECT_THAT(broken(R"({"recall": 0.5})"), ElementsAre(HasSubstr("original: recall is 0.1")));
  EXPECT_EQ(broken(R"({"force_error_n": 0.2})").size(), 2u);
  EXPECT_EQ(broken(R"({"late_frames": 2})").size(), 2u);
  EXPECT_THAT(broken(R"({"fcl_disagreements": 4})"), ElementsAre(HasSubstr("disagreements with FCL is 5")));
}

TEST(Acceptance, WhatWasNotMeasuredBreaksItsLimitAndSaysSo) {
  RunSummary unmeasured = summary();
  unmeasured.methods[1].recall = UNSET;
  EXPECT_THAT(broken_limits(with_limits(R"({"recall": 0.05})").acceptance, unmeasured),
              ElementsAre("improved: recall is not measured, the experiment wants at least 0.05"));
  unmeasured.fcl_frames = 0;
  EXPECT_THAT(
      broken_limits(with_limits(R"({"fcl_disagreements": 0})").acceptance, unmeasured),
      Contains("improved: number of disagreements with FCL is not measured, the experiment wants at most 0"));
}

TEST(Acceptance, AWrongNearestDistanceBreaksWhateverIsLimited) {
  RunSummary wrong = summary();
  wrong.nearest_errors.push_back({"improved", 3, {}});
  wrong.nearest_errors[0].first.frame = 12;
  wrong.nearest_errors[0].first.distance = 0.0043;
  wrong.nearest_errors[0].first.fcl_distance = 0.0;
  const auto of = [&](const std::string& limits) {
    return broken_limits(with_limits(limits).acceptance, wrong);
  };
  EXPECT_THAT(of(R"({"late_frames": 3})"),
              ElementsAre(AllOf(HasSubstr("frame 12"), HasSubstr("0.0043 m"), HasSubstr("FCL's 0 m"))));
  EXPECT_THAT(of(R"({"late_frames": 3, "methods": ["original"]})"), IsEmpty());
  EXPECT_THAT(of("{}"), IsEmpty()) << "nothing is asked";
  EXPECT_THAT(summary_text(wrong), HasSubstr("ERROR: improved promises the complete set"));
  EXPECT_THAT(summary_json(wrong), HasSubstr("nearest_errors"));
}

TEST(Acceptance, LimitsMayBeForSomeMethodsOnly) {
  EXPECT_THAT(broken(R"({"recall": 0.5, "methods": ["improved"]})"), IsEmpty());
}

TEST(Acceptance, LimitsOnWhatIsNotProbedAreRefused) {
  const auto message = [](const std::string& limits, const Override& override) {
    return testing::message_of<UsageError>([&] { with_limits(limits, {override}); });
  };
  EXPECT_THAT(message(R"({"recall": 1})", "/probes/truth/stride_frames=0"), HasSubstr("/limits/recall"));
  EXPECT_THAT(message(R"({"fcl_disagreements": 0})", "/probes/fcl/stride_frames=0"),
              HasSubstr("/limits/fcl_disagreements"));
  EXPECT_THAT(message(R"({"methods": ["orignal"]})", "/name=x"), HasSubstr("/limits/methods/0"));
}

}  // namespace
}  // namespace lmdbench
