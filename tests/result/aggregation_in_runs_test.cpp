// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/experiment/experiment.h>
#include <lmdbench/force/aggregation.h>
#include <lmdbench/prepare/plan.h>
#include <lmdbench/result/run_to_file.h>
#include <lmdbench/run/run.h>
#include <lmdbench/stability/stability_map.h>
#include <lmdbench/sweep/sweep.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <result_file/result_reading.h>
#include <support/committed.h>
#include <support/message_of.h>
#include <support/source_directory.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

/// `/force/aggregation` of an experiment: its effect on a run, its result, plan and probes.
namespace lmdbench {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::OpenResult;
using testing::ScratchDirectory;

const std::string BOTH =
    R"(/methods=[{"name": "improved", "force_law": "exponential"}, {"name": "certified", "force_law": "exponential"}])";

const std::string NO_TRUTH = "/probes/truth/stride_frames=0";

/// The shapes in a pose where several LMDs share a component, with further overrides.
Experiment shapes_in_contact(std::vector<Override> overrides = {}) {
  overrides.insert(overrides.begin(), {"/frames=280", "/driver/repetitions=1", "/probes/fcl/stride_frames=0",
                                       "/probes/truth/stride_frames=60", BOTH});
  return load_experiment(testing::SHAPES_FILE, overrides);
}

double largest_difference(const MethodRecord& a, const MethodRecord& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.frames.size(); ++i)
    largest = std::max(largest, (a.frames[i].force - b.frames[i].force).norm());
  return largest;
}

TEST(AggregationInRuns, IsOfMethodsThatFindSaddles) {
  const RunResult sum = run_experiment(shapes_in_contact({"/frames=360"}));
  const double one = sum.prepared.profiles[0].force.maximum_force;
  for (const Aggregation& law : aggregations()) {
    // layered takes long; a test below has a profile for it.
    if (law.needs == AggregationNeeds::MINIMA || law.needs == AggregationNeeds::SURFACE) continue;
    const std::string name(law.name);
    const RunResult run = run_experiment(shapes_in_contact({"/force/aggregation=" + name, "/frames=360"}));
    EXPECT_GT(largest_difference(run.records[1], sum.records[1]), 0.1 * one) << name;
    EXPECT_EQ(run.records[0].result_hash, sum.records[0].result_hash) << "improved has no saddles";
    EXPECT_THAT(run.warnings, Contains(HasSubstr("method improved finds no saddles"))) << name;
    EXPECT_THAT(run.warnings, Not(Contains(HasSubstr("without an index")))) << name;
    // The probed truth uses the same aggregation.
    ASSERT_FALSE(run.comparisons(1).empty());
    double most = 0.0;
    for (std::size_t k = 0; k < run.comparisons(1).size(); ++k) {
      EXPECT_EQ(run.comparisons(1)[k].force_error, 0.0) << name;
      most = std::max(most, std::abs(run.comparisons(0)[k].force_error - sum.comparisons(0)[k].force_error));
    }
    EXPECT_GT(most, 1e-4 * one) << name;
    ASSERT_TRUE(run.tracks[0].truth()->complete);
    const auto exponential = static_cast<std::size_t>(ForceLaw::EXPONENTIAL);
    for (std::size_t i = 0; i < run.records[1].frames.size(); ++i)
      EXPECT_EQ(run.tracks[0].truth()->complete->force[exponential][i], run.records[1].frames[i].force);
  }
  EXPECT_THAT(sum.warnings, Not(Contains(HasSubstr("saddles"))));
}

TEST(AggregationInRuns, StandsInTheResult) {
  const ScratchDirectory scratch;
  run_experiment_to_file(shapes_in_contact({"/force/aggregation=shared", "/frames=60"}), scratch / "r.h5",
                         {"lmdbench", "run"});
  const OpenResult result(scratch / "r.h5");
  EXPECT_EQ(result.text_attribute("/methods/certified", "aggregation"), "shared");
  EXPECT_EQ(result.text_attribute("/methods/improved", "aggregation"), "sum");
  EXPECT_TRUE(result.has("/methods/certified/lmds_without_index"));
  EXPECT_FALSE(result.has("/methods/improved/lmds_without_index"));
  EXPECT_THAT(result.strings("/scene/warnings"), Contains(HasSubstr("its LMDs are summed")));

  run_experiment_to_file(shapes_in_contact({"/frames=60"}), scratch / "s.h5", {"lmdbench", "run"});
  const OpenResult plain(scratch / "s.h5");
  EXPECT_EQ(plain.text_attribute("/methods/certified", "aggregation"), "sum");
  EXPECT_FALSE(plain.has("/methods/certified/lmds_without_index"));
}

TEST(AggregationInRuns, WhatHasNoIndexIsSaidAndCounted) {
  // Beside a sheet, whose border is nearest.
  const ScratchDirectory scratch;
  std::ofstream(scratch / "beside.tum") << "0 0.11 0 0 0 0 0 1\n0.02 0.08 0 0 0 0 0 1\n";
  const RunResult run = run_experiment(
      shapes_in_contact({"/force/aggregation=signed", "/fixed/0/mesh=patch", "/force/cutoff_diagonal=0.2",
                         "/path/file=" + (scratch / "beside.tum").string()}));
  EXPECT_THAT(run.warnings, Contains(HasSubstr("boundary edges")));
  const std::vector<FrameRecord>& frames = run.records[1].frames;
  const auto count =
      std::ranges::count_if(frames, [](const FrameRecord& f) { return f.lmds_without_index > 0; });
  ASSERT_GT(count, 0) << "or the path does not come near the border";
  EXPECT_THAT(run.warnings,
              Contains(HasSubstr("certified: LMDs without an index in " + std::to_string(count))));
  for (const FrameRecord& frame : frames) EXPECT_LE(frame.lmds_without_index, frame.lmd_count);
}

TEST(AggregationInRuns, EveryProfileHasItsOwn) {
  const RunResult run = run_experiment(shapes_in_contact(
      {R"(/force=[{"name": "plain", "cutoff_m": 0.002, "maximum_force_n": 1},)"
       R"( {"name": "continuous", "cutoff_m": 0.002, "maximum_force_n": 1, "aggregation": "shared"},)"
       R"( {"name": "conforming", "cutoff_m": 0.002, "maximum_force_n": 1, "aggregation": "layered"}])",
       NO_TRUTH}));
  const auto record = [&](const std::string& label) -> const MethodRecord& {
    return *std::ranges::find(run.records, label, &MethodRecord::label);
  };
  EXPECT_GT(largest_difference(record("certified-plain"), record("certified-continuous")), 0.1);
  EXPECT_GT(largest_difference(record("certified-conforming"), record("certified-continuous")), 1e-3);
  EXPECT_EQ(largest_difference(record("improved-plain"), record("improved-continuous")), 0.0);
}

TEST(AggregationInRuns, PlanAndSchemaNameIt) {
  const Experiment experiment = shapes_in_contact({"/force/aggregation=signed"});
  const std::string text = plan_text(make_plan(experiment), experiment);
  EXPECT_THAT(text, HasSubstr("force/aggregation: certified signed; improved: summed"));
  EXPECT_THAT(text, HasSubstr("force law exponential, aggregation signed"));
  EXPECT_THAT(plan_json(make_plan(experiment), experiment), HasSubstr(R"("aggregation": "signed")"));
  EXPECT_TRUE(make_plan(experiment).needs(Part::CRITICAL_PAIRS));
  EXPECT_FALSE(make_plan(shapes_in_contact()).needs(Part::CRITICAL_PAIRS));
  const auto& choice = experiment_schema()["properties"]["force"]["properties"]["aggregation"];
  EXPECT_EQ(choice["enum"].get<std::vector<std::string>>(), aggregation_names());
}

TEST(AggregationInRuns, OneThatIsNotThereIsNamed) {
  EXPECT_THAT(testing::message_of<UsageError>([] { shapes_in_contact({"/force/aggregation=shard"}); }),
              HasSubstr("/force/aggregation"));
}

const std::string LOOP = R"(/loop={"kind": "closed", "hand": "postural-arm", "delay_frames": 1})";
const std::string ALONE = R"(/methods=[{"name": "certified", "force_law": "exponential"}])";

TEST(AggregationInRuns, AClosedLoopFeelsIt) {
  const auto loop = [](const std::string& aggregation) {
    return run_experiment(shapes_in_contact({LOOP, ALONE, "/force/aggregation=" + aggregation}));
  };
  const RunResult sum = loop("sum"), shared = loop("shared");
  EXPECT_GT(largest_difference(sum.records[0], shared.records[0]), 0.0);
  EXPECT_NE(sum.records[0].poses.back().translation, shared.records[0].poses.back().translation);
  for (const TruthComparison& row : shared.comparisons(0)) EXPECT_EQ(row.force_error, 0.0);
}

TEST(AggregationInRuns, MapsTakeTheStiffnessUnderIt) {
  // The sum is stiffer than the shared force here; F_max follows from the stiffness asked for.
  const RunResult sum = run_experiment(shapes_in_contact({ALONE, NO_TRUTH})),
                  shared = run_experiment(shapes_in_contact({ALONE, NO_TRUTH, "/force/aggregation=shared"}));
  std::size_t frame = 0;
  double ratio = 1.0;
  for (std::size_t i = 0; i < sum.records[0].frames.size(); ++i) {
    const double here = sum.records[0].frames[i].effective_stiffness;
    const double other = shared.records[0].frames[i].effective_stiffness;
    if (!(other > 0.0) || !(here / other > ratio)) continue;
    ratio = here / other;
    frame = i;
  }
  ASSERT_GT(ratio, 1.2);
  // One that is wrong by the ratio of stiffness does not carry the load.
  const double tolerance = 0.5 * (1.0 - 1.0 / ratio) * LOAD_N;
  const ScratchDirectory scratch;
  const Pose& pose = sum.prepared.input.poses[frame];
  std::ofstream(scratch / "rest.tum")
      << fmt::format("0 {0} {1} {2} {3} {4} {5} {6}\n1 {0} {1} {2} {3} {4} {5} {6}\n", pose.translation.x(),
                     pose.translation.y(), pose.translation.z(), pose.rotation.x(), pose.rotation.y(),
                     pose.rotation.z(), pose.rotation.w());
  const auto mean_force = [&](const std::string& aggregation) {
    Experiment experiment = shapes_in_contact(
        {LOOP, ALONE, "/force/aggregation=" + aggregation, "/path/file=" + (scratch / "rest.tum").string()});
    double found = 0.0;
    map_stability(experiment, {{300.0}, {0}, 1, 700}, [&](const StabilityMapRun& run) {
      found = run.force_mean_n;
      return true;
    });
    return found;
  };
  for (const std::string aggregation : {"sum", "shared"})
    EXPECT_NEAR(mean_force(aggregation), LOAD_N, tolerance) << aggregation << ", ratio " << ratio;
}

}  // namespace
}  // namespace lmdbench
