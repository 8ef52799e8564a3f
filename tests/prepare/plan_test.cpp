// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/methods/registry.h>
#include <lmdbench/prepare/plan.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/committed.h>
#include <support/source_directory.h>

#include <filesystem>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Experiment planned_shapes(const std::vector<Override>& overrides = {}) {
  return load_experiment(testing::SHAPES_FILE, overrides);
}

TEST(Plan, FollowsTheExperiment) {
  const Plan full = make_plan(planned_shapes());
  EXPECT_TRUE(full.needs(Part::LOCAL_TRACKING));
  EXPECT_FALSE(full.needs(Part::SEARCH_PER_FRAME));
  EXPECT_TRUE(full.needs("truth probe"));
  EXPECT_TRUE(full.needs("FCL cross-check"));
  EXPECT_FALSE(full.needs(Part::LMD_LISTS));
  const Plan bare = make_plan(planned_shapes({"/probes/truth/stride_frames=0", "/probes/fcl/stride_frames=0",
                                              R"(/methods=[{"name":"exhaustive","force_law":"linear"}])"}));
  EXPECT_FALSE(bare.needs(Part::LOCAL_TRACKING));
  EXPECT_TRUE(bare.needs(Part::SEARCH_PER_FRAME));
  EXPECT_FALSE(bare.needs("truth probe"));
  EXPECT_FALSE(bare.needs("FCL cross-check"));
}

TEST(Plan, EveryPartSaysWhy) {
  for (const PlanItem& item : make_plan(planned_shapes()).items) {
    EXPECT_FALSE(item.name.empty());
    EXPECT_FALSE(item.why.empty()) << item.name;
  }
}

TEST(Plan, JsonHoldsTheResolvedExperiment) {
  const Experiment experiment = planned_shapes();
  const auto json = nlohmann::json::parse(plan_json(make_plan(experiment), experiment));
  EXPECT_EQ(json["experiment"]["frame_rate_hz"], 1000);
  EXPECT_EQ(json["needed"].size() + json["left_out"].size(), make_plan(experiment).items.size());
  EXPECT_THAT(plan_text(make_plan(experiment), experiment), HasSubstr("left out:\n"));
}

TEST(Plan, ListsEveryMethodWithItsOptionsAndDefaults) {
  const Experiment experiment = planned_shapes({"/methods/1/visibility=off"});
  const auto json = nlohmann::json::parse(plan_json(make_plan(experiment), experiment));
  ASSERT_EQ(json["methods"].size(), experiment.methods.size());
  for (std::size_t i = 0; i < experiment.methods.size(); ++i) {
    const MethodDescription& method = method_description(experiment.methods[i].name);
    EXPECT_EQ(json["methods"][i]["summary"], method.summary);
    EXPECT_EQ(json["methods"][i]["promise"], std::string(to_string(method.promise)));
    ASSERT_EQ(json["methods"][i]["options"].size(), method.options.size());
    for (const auto& option : json["methods"][i]["options"]) {
      const std::string key = option["key"].get<std::string>();
      EXPECT_EQ(option["default"], method.options[key]["default"]);
      EXPECT_EQ(option["value"], key == "visibility" ? "off" : option["default"]) << key;
    }
  }
  EXPECT_THAT(plan_text(make_plan(experiment), experiment),
              AllOf(HasSubstr("\"off\" (default \"vertex-normal\")"), HasSubstr("line_cone ")));
}

TEST(Plan, EveryCommittedExperimentIsValid) {
  int valid = 0;
  for (const char* folder : {"", "extreme/", "stability/"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(LMDBENCH_SOURCE_DIR "/experiments/") + folder))
      if (entry.path().extension() == ".json") {
        const Experiment experiment = load_experiment(entry.path());
        EXPECT_NO_THROW(make_plan(experiment)) << entry.path();
        ++valid;
      }
  EXPECT_GT(valid, 30);
}

}  // namespace
}  // namespace lmdbench
