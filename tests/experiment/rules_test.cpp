// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/experiment/rules.h>
#include <lmdbench/run/run.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/message_of.h>
#include <support/scratch_directory.h>
#include <support/source_directory.h>

#include <algorithm>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;
using testing::ScratchDirectory;

/// A sphere that comes near another one and rests there for half the frames.
std::string resting_path() {
  std::string text;
  for (int i = 0; i <= 100; ++i)
    text += fmt::format("{} {} 0 0 0 0 0 1\n", 0.002 * i, 0.115 - 0.0003 * std::min(i, 50));
  return text;
}

Experiment experiment(const std::string& path, std::vector<Override> overrides = {}) {
  overrides.insert(overrides.begin(), {"/path/file=" + path, "/mesh_folder=" LMDBENCH_SOURCE_DIR "/meshes",
                                       R"(/methods=[{"name": "certified"}, {"name": "improved"}])",
                                       "/driver/repetitions=1", "/driver/search_latency_frames=1",
                                       "/driver/search_every_frames=5", "/path/interpolation=linear",
                                       "/probes/truth/stride_frames=7", "/probes/fcl/stride_frames=9"});
  return parse_experiment(
      R"({"moving": {"mesh": "sphere", "diagonal_m": 0.17}, "fixed": [{"mesh": "sphere", "diagonal_m": 0.17}],
          "force": {"cutoff_m": 0.01, "maximum_force_n": 3}})",
      "/data/e.json", overrides);
}

const RuleDecision& decision(const RunResult& result, Rule rule) {
  return result.plan.rules.at(static_cast<std::size_t>(rule));
}

TEST(Rules, EachHasASwitchInTheSchemaAndStandsInItsPlace) {
  const auto& properties = experiment_schema()["properties"]["plan"]["properties"];
  EXPECT_EQ(properties.size(), RULE_COUNT);
  for (std::size_t i = 0; i < RULE_COUNT; ++i) {
    const RuleDescription& rule = rule_descriptions()[i];
    EXPECT_EQ(static_cast<std::size_t>(rule.rule), i);
    EXPECT_EQ(properties[std::string(rule.name)]["default"], "auto");
    EXPECT_FALSE(rule.effect.empty());
    EXPECT_FALSE(rule.saving.empty());
  }
}

TEST(Rules, AllHoldOnASceneThatNeedsThem) {
  const ScratchDirectory scratch;
  const RunResult result = run_experiment(experiment(scratch.write("p.tum", resting_path())));
  for (const RuleDecision& rule : result.plan.rules) EXPECT_TRUE(rule.on) << rule.reason;
  EXPECT_THAT(decision(result, Rule::REPEATED_POSE).reason,
              HasSubstr("27 of 56 exhaustive searches and 10 of 23 cross-checks"));
  EXPECT_THAT(decision(result, Rule::TRUTH_IN_CONTACT).reason, HasSubstr("of 56 exhaustive searches"));
  const RunResult only_fcl =
      run_experiment(experiment(scratch.write("p.tum", resting_path()), {"/probes/truth/stride_frames=0"}));
  EXPECT_TRUE(decision(only_fcl, Rule::REPEATED_POSE).on) << "the cross-check repeats, too";
  EXPECT_EQ(result.prepared.scene().moving, result.prepared.scene().fixed.front().body);
  EXPECT_EQ(result.prepared.meshes.size(), 2u);
  EXPECT_EQ(result.prepared.meshes[1].role, "fixed_0");
}

TEST(Rules, NoneHoldsOnASceneThatDoesNot) {
  const ScratchDirectory scratch;
  const RunResult result =
      run_experiment(experiment(scratch.write("p.tum", "0 0.1 0 0 0 0 0 1\n"),
                                {"/fixed/0/pose/translation_m=[0,0.001,0]", "/probes/truth/stride_frames=0",
                                 "/probes/fcl/stride_frames=0"}));
  for (const RuleDecision& rule : result.plan.rules) {
    EXPECT_FALSE(rule.on) << rule.reason;
    EXPECT_FALSE(rule.reason.empty());
  }
}

TEST(Rules, WhereTheConditionDoesNotHoldOnIsAnError) {
  const ScratchDirectory scratch;
  const Experiment moves = experiment(scratch.write("p.tum", "0 0.1 0 0 0 0 0 1\n0.01 0.101 0 0 0 0 0 1\n"),
                                      {"/plan/repeated_pose=on"});
  EXPECT_THAT(testing::message_of<UsageError>([&] { run_experiment(moves); }),
              HasSubstr("/plan/repeated_pose: cannot be on: 0 of 2 exhaustive searches"));
}

/// Forces, sets, truth, contact and cross-check of two runs are the same bits.
void expect_equal(const RunResult& with, const RunResult& without, const std::string& rule) {
  ASSERT_EQ(with.records.size(), without.records.size());
  for (std::size_t i = 0; i < with.records.size(); ++i) {
    EXPECT_EQ(with.records[i].result_hash, without.records[i].result_hash) << rule;
    ASSERT_EQ(with.comparisons(i).size(), without.comparisons(i).size());
    for (std::size_t k = 0; k < with.comparisons(i).size(); ++k)
      EXPECT_EQ(with.comparisons(i)[k].force_error, without.comparisons(i)[k].force_error) << rule;
  }
  EXPECT_EQ(with.in_contact, without.in_contact) << rule;
  const Track& a = with.tracks.front();
  const Track& b = without.tracks.front();
  const std::vector<TruthFrame>&a_truth = a.truth()->frames, &b_truth = b.truth()->frames;
  ASSERT_EQ(a_truth.size(), b_truth.size());
  for (std::size_t k = 0; k < a_truth.size(); ++k) {
    EXPECT_EQ(a_truth[k].lmds.size(), b_truth[k].lmds.size()) << rule;
    EXPECT_EQ(a_truth[k].force, b_truth[k].force) << rule;
    EXPECT_EQ(a_truth[k].force_jump, b_truth[k].force_jump) << rule;
  }
  ASSERT_EQ(a.fcl()->frames.size(), b.fcl()->frames.size());
  for (std::size_t k = 0; k < a.fcl()->frames.size(); ++k)
    EXPECT_EQ(a.fcl()->frames[k].lmdbench_distance, b.fcl()->frames[k].lmdbench_distance) << rule;
}

TEST(Rules, NoneChangesAResult) {
  const ScratchDirectory scratch;
  const std::string path = scratch.write("p.tum", resting_path());
  const RunResult all = run_experiment(experiment(path));
  EXPECT_GT(std::count(all.in_contact.begin(), all.in_contact.end(), true), 100);
  EXPECT_GT(all.records[0].frames.back().lmd_count, 0);
  for (const RuleDescription& rule : rule_descriptions()) {
    const RunResult without = run_experiment(experiment(path, {fmt::format("/plan/{}=off", rule.name)}));
    EXPECT_FALSE(decision(without, rule.rule).on);
    EXPECT_EQ(decision(without, rule.rule).reason, "switched off");
    expect_equal(all, without, std::string(rule.name));
  }
}

TEST(Rules, ATimedFrameIsSearchedWhereverThePathRests) {
  const ScratchDirectory scratch;
  const std::string path = scratch.write("p.tum", resting_path());
  const RunResult with = run_experiment(experiment(path));
  const RunResult without = run_experiment(experiment(path, {"/plan/repeated_pose=off"}));
  for (std::size_t method = 0; method < 2; ++method)
    EXPECT_EQ(with.records[method].work_hash, without.records[method].work_hash);
}

TEST(Rules, TheyAreInThePlan) {
  const ScratchDirectory scratch;
  const Experiment scene = experiment(scratch.write("p.tum", resting_path()), {"/plan/shared_mesh=off"});
  const RunResult result = run_experiment(scene);
  const auto json = nlohmann::json::parse(plan_json(result.plan, scene));
  ASSERT_EQ(json["rules"].size(), RULE_COUNT);
  EXPECT_EQ(json["rules"][0]["name"], "shared_mesh");
  EXPECT_EQ(json["rules"][0]["on"], false);
  EXPECT_EQ(json["rules"][1]["on"], true);
  EXPECT_THAT(plan_text(result.plan, scene), HasSubstr("contact_forecast  on "));
}

}  // namespace
}  // namespace lmdbench
