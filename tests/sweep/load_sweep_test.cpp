// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/sweep/sweep.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/message_of.h>
#include <support/scratch_directory.h>
#include <support/source_directory.h>

#include <filesystem>

namespace lmdbench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;
using testing::ScratchDirectory;

const std::string SHAPES = LMDBENCH_SOURCE_DIR "/experiments/shapes.json";

class LoadSweep : public ::testing::Test {
 protected:
  std::string write(const std::string& series, const std::string& rest = "") {
    return scratch_.write("sweep.json", R"({"name": "s", "experiments": [")" + SHAPES + R"("], "series": [)" +
                                            series + "]" + rest + "}");
  }
  std::string refusal(const std::string& series, const std::string& rest = "") {
    const std::string file = write(series, rest);
    return message_of<Error>([&] { load_sweep(file); });
  }
  ScratchDirectory scratch_;
};

TEST_F(LoadSweep, MakesEveryCombinationOfAxesAndKeepsPlacesOfOneAxisTogether) {
  const Sweep sweep = load_sweep(write(R"(
    {"method": {"name": "improved", "force_law": "exponential"},
     "axes": [{"/driver/search_every_frames": [5, 50], "/driver/search_latency_frames": [4, 40]},
              {"/method/visibility": ["off", "orthogonal"]}]},
    {"label": "other", "method": {"name": "certified", "force_law": "linear"}})"));
  ASSERT_EQ(sweep.points.size(), 5u);
  std::vector<std::string> texts;
  for (const SweepPoint& point : sweep.points) texts.push_back(point.series + " " + point.axes_text());
  EXPECT_THAT(
      texts,
      ElementsAre("improved search_every_frames=5, search_latency_frames=4, visibility=\"off\"",
                  "improved search_every_frames=5, search_latency_frames=4, visibility=\"orthogonal\"",
                  "improved search_every_frames=50, search_latency_frames=40, visibility=\"off\"",
                  "improved search_every_frames=50, search_latency_frames=40, visibility=\"orthogonal\"",
                  "other "));
  const Experiment& second = sweep.points[3].experiment;
  EXPECT_EQ(second.driver.search_every_frames, 50);
  EXPECT_EQ(second.driver.search_latency_frames, 40);
  ASSERT_EQ(second.methods.size(), 1u);
  EXPECT_EQ(second.methods[0].options["visibility"], "orthogonal");
  EXPECT_EQ(second.probe_stride("truth"), 0) << "truth is the sweep's own business";
  EXPECT_EQ(sweep.points[0].scene, "shapes");
  EXPECT_EQ(sweep.from_frame, 40) << "the largest latency";
  EXPECT_EQ(sweep.points[4].experiment.methods[0].force_law, ForceLaw::LINEAR);
}

TEST_F(LoadSweep, SetsValuesOfTheSweepThenOfTheSeriesThenOfTheAxes) {
  const Sweep sweep =
      load_sweep(write(R"(
    {"method": {"name": "certified", "force_law": "linear"}, "set": {"/force/sharpness": 2, "/frames": 30},
     "axes": [{"/frames": [40]}], "truth": {"/moving/mesh": "sphere"}})",
                       R"(, "set": {"/force/sharpness": 1, "/force/maximum_force_n": 7}, "from_frame": 3)"));
  const Experiment& experiment = sweep.points.at(0).experiment;
  EXPECT_EQ(experiment.profiles.at(0).sharpness, 2.0);
  EXPECT_EQ(experiment.profiles.at(0).maximum_force_n, 7.0);
  EXPECT_EQ(experiment.frames, 40);
  EXPECT_EQ(experiment.held().mesh, "blob");
  EXPECT_EQ(sweep.points[0].truth.held().mesh, "sphere");
  EXPECT_EQ(sweep.points[0].truth.frames, 40);
  EXPECT_EQ(sweep.from_frame, 3);
}

TEST_F(LoadSweep, WhatChangesTheTruthMakesProblemsApart) {
  const auto problems = [&](const std::string& series, const std::string& rest = "") {
    std::vector<std::string> names;
    for (const SweepPoint& point : load_sweep(write(series, rest)).points) names.push_back(point.problem);
    return names;
  };
  const std::string method = R"({"method": {"name": "improved", "force_law": "exponential"})";
  EXPECT_THAT(
      problems(
          method +
          R"(, "axes": [{"/driver/search_every_frames": [20, 50]}, {"/method/visibility": ["off", "orthogonal"]}]})"),
      ElementsAre("shapes", "shapes", "shapes", "shapes"))
      << "a schedule and a method's options are no other question";
  EXPECT_THAT(problems(method + R"(, "axes": [{"/plan/repeated_pose": ["off", "auto"]}]})"),
              ElementsAre("shapes", "shapes"))
      << "nor are the plan's rules, which change no bit";
  EXPECT_THAT(
      problems(method + R"(, "axes": [{"/force/sharpness": [1, 2]}, {"/moving/mesh": ["blob", "sphere"]}]})"),
      ElementsAre(
          "shapes, force/sharpness 1, moving/mesh blob", "shapes, force/sharpness 1, moving/mesh sphere",
          "shapes, force/sharpness 2, moving/mesh blob", "shapes, force/sharpness 2, moving/mesh sphere"));
  EXPECT_THAT(
      problems(method + R"(, "label": "a"}, )" + method + R"(, "label": "b", "set": {"/frames": 30}})"),
      ElementsAre("shapes", "shapes, frames 30"))
      << "whether an axis or a series changed it";
  EXPECT_THAT(problems(method + R"(, "label": "a"}, )" + method +
                       R"(, "label": "b", "set": {"/moving/mesh": "sphere"},
                                 "truth": {"/moving/mesh": "blob"}})"),
              ElementsAre("shapes", "shapes"))
      << "coarser meshes with the truth of the fine ones";
}

TEST_F(LoadSweep, SaysWhatIsWrongAndWhere) {
  const std::string method = R"("method": {"name": "improved", "force_law": "linear"})";
  EXPECT_THAT(refusal("{" + method + R"(, "axis": []})"), HasSubstr("did you mean \"axes\"?"));
  EXPECT_THAT(refusal("{" + method + R"(, "axes": [{"/frames": [10, 20], "/frame_rate_hz": [1000]}]})"),
              ::testing::AllOf(HasSubstr("/series/0/axes/0"), HasSubstr("equally many")));
  EXPECT_THAT(refusal("{" + method + R"(, "axes": [{}]})"), HasSubstr("an axis without a place"));
  EXPECT_THAT(refusal("{" + method + "},{" + method + "}"), HasSubstr("two series are called \"improved\""));
  EXPECT_THAT(refusal("{" + method + R"(, "axes": [{"/method/visibillity": ["off"]}]})"),
              ::testing::AllOf(HasSubstr("/series/0"), HasSubstr("did you mean \"visibility\"?")));
  EXPECT_THAT(refusal("{" + method + R"(, "axes": [{"/driver/search_latency_frames": [0, 21]}]})"),
              HasSubstr("let the latency be at most search_every_frames"));
  EXPECT_THAT(refusal("{" + method + R"(, "set": {"/loop/kind": "closed"}})"),
              HasSubstr("sweep in an open loop"));
  EXPECT_THAT(refusal("{" + method + R"(, "set": {"/force": [
      {"name": "a", "cutoff_m": 0.01, "maximum_force_n": 1}, {"name": "b", "cutoff_m": 0.02, "maximum_force_n": 1}]}})"),
              HasSubstr("a force profile a point"));
  EXPECT_THAT(refusal("{" + method + R"(, "axes": [{"/frames": [10, 20]}, {"/frames": [30, 40]}]})"),
              ::testing::AllOf(HasSubstr("/series/0/axes/1"), HasSubstr("/frames is in two axes")));
  EXPECT_THAT(refusal("{" + method + R"(, "axes": [{"/frames": [10, 20, 10]}]})"),
              HasSubstr("points 0 and 2 are the same: improved, frames=10"));
  EXPECT_THAT(refusal("{" + method + R"(, "axes": [{"/record/lmds": [false, true]}]})"),
              HasSubstr("points 0 and 1 are the same"));
  EXPECT_THAT(refusal("{" + method + R"(, "axes": [{"/driver/repetitions": [1, 2]}]})"),
              ::testing::AllOf(HasSubstr("/driver/repetitions"), HasSubstr("repeats its points itself")));
  EXPECT_THAT(refusal("{" + method + R"(, "set": {"/driver/kind": "realtime"}})"),
              ::testing::AllOf(HasSubstr("/driver/kind"), HasSubstr("on the clock")));
  EXPECT_THAT(refusal("{" + method + R"(, "set": {"/methods/-": {"name": "certified"}}})"),
              ::testing::AllOf(HasSubstr("/methods"), HasSubstr("another method than the series' own")));
  EXPECT_THAT(refusal(R"({"method": {"name": "improvd", "force_law": "linear"}})"), HasSubstr("improved"));
  EXPECT_THAT(message_of<UsageError>([&] { load_sweep(scratch_ / "none.json"); }), HasSubstr("sweep file"));
}

TEST_F(LoadSweep, RefusesMorePointsThanAnybodyMeans) {
  std::string thousand = "[1";
  for (int i = 2; i <= 1000; ++i) thousand.append(",").append(std::to_string(i));
  thousand += "]";
  EXPECT_THAT(refusal(R"({"method": {"name": "certified", "force_law": "linear"}, "axes": [{"/frames": )" +
                      thousand + R"(}, {"/force/sharpness": )" + thousand + "}]}"),
              HasSubstr("more than 100000 points"));
}

TEST(CommittedSweeps, AreAllRight) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LMDBENCH_SOURCE_DIR "/experiments/sweeps")) {
    if (entry.path().extension() != ".json") continue;
    const Sweep sweep = load_sweep(entry.path());
    EXPECT_EQ(sweep.name, entry.path().stem()) << "results are found by name";
    EXPECT_FALSE(sweep.title.empty()) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0u);
}

}  // namespace
}  // namespace lmdbench
