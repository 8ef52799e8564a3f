// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/metrics/summary.h>
#include <lmdbench/result/run_to_file.h>
#include <lmdbench/run/run.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <result/deterministic_datasets.h>
#include <result_file/result_reading.h>
#include <support/committed.h>
#include <support/source_directory.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::Contains;
using testing::deterministic_datasets;
using ::testing::HasSubstr;
using testing::OpenResult;
using testing::ScratchDirectory;
using testing::SHAPES_FILE;
using ::testing::StartsWith;

/// The shapes experiment up to its first contact, so that the tests stay quick.
Experiment short_shapes(std::vector<Override> overrides = {}) {
  overrides.insert(overrides.begin(),
                   {"/frames=320", "/driver/repetitions=2", "/record/lmds=true", "/record/torque=true"});
  return load_experiment(SHAPES_FILE, overrides);
}

RunResult run_to(const std::filesystem::path& file, const Experiment& experiment) {
  return run_experiment_to_file(experiment, file, {"lmdbench", "run"});
}

TEST(Run, TwoRunsLeaveTheSameBitsButForTimesAndProvenance) {
  const ScratchDirectory scratch;
  run_to(scratch / "a.h5", short_shapes());
  run_to(scratch / "b.h5", short_shapes());
  const auto a = deterministic_datasets(scratch / "a.h5");
  EXPECT_GT(a.size(), 80u);
  EXPECT_TRUE(a.count("methods/improved/force"));
  EXPECT_TRUE(a.count("methods/original/truth/recall"));
  EXPECT_TRUE(a.count("methods/original/lmds/distance"));
  EXPECT_TRUE(a == deterministic_datasets(scratch / "b.h5"));
}

TEST(Run, OrderOfMethodsBlocksAndRepetitionsDoesNotMatter) {
  const ScratchDirectory scratch;
  run_to(scratch / "a.h5", short_shapes());
  run_to(
      scratch / "b.h5",
      short_shapes(
          {R"(/methods=[{"name":"improved","force_law":"exponential"},{"name":"original","force_law":"linear"}])",
           "/driver/repetitions=3", "/driver/block_frames=7"}));
  const auto a = deterministic_datasets(scratch / "a.h5");
  const auto b = deterministic_datasets(scratch / "b.h5");
  EXPECT_TRUE(a == b);
  const OpenResult first(scratch / "a.h5"), second(scratch / "b.h5");
  for (const std::string texts : {"/scene/warnings", "/crosscheck/fcl/exceptions/who"}) {
    EXPECT_FALSE(first.strings(texts).empty()) << texts << ": or there is nothing to compare";
    EXPECT_EQ(first.strings(texts), second.strings(texts));
  }
  EXPECT_EQ(first.text_attribute("/methods/improved", "result_hash"),
            second.text_attribute("/methods/improved", "result_hash"));
}

TEST(Run, AnotherSceneLeavesOtherBits) {
  const ScratchDirectory scratch;
  run_to(scratch / "a.h5", short_shapes());
  run_to(scratch / "b.h5", short_shapes({"/force/maximum_force_n=2.5"}));
  EXPECT_FALSE(deterministic_datasets(scratch / "a.h5") == deterministic_datasets(scratch / "b.h5"));
}

/// A method's group has only the datasets and counters of its description, and attributes that say
/// its kind.
TEST(Run, GroupsHoldWhatTheirMethodsDescribe) {
  const ScratchDirectory scratch;
  nlohmann::json methods = nlohmann::json::array();
  for (const std::string& name : method_names()) methods.push_back({{"name", name}, {"force_law", "linear"}});
  run_to(scratch / "r.h5", short_shapes({"/frames=25", "/methods=" + methods.dump()}));
  const OpenResult result(scratch / "r.h5");
  for (const MethodDescription& method : method_descriptions()) {
    const std::string group = "/methods/" + method.name;
    EXPECT_EQ(result.text_attribute(group, "about"), method.summary);
    EXPECT_EQ(result.text_attribute(group, "promise"), to_string(method.promise));
    EXPECT_EQ(result.integer_attribute(group, "tracks_locally"), method.tracks_locally);
    EXPECT_EQ(result.integer_attribute(group, "trackings_after_search"), method.trackings_after_search);
    EXPECT_EQ(result.integer_attribute(group, "method_order"), static_cast<int>(method_order(method.name)));
    for (const std::string name : {"lmd_age", "lmd_count_before_reduction", "reduction_ratio", "global_frame",
                                   "candidates", "global_search_time"})
      EXPECT_EQ(result.has(group + "/" + name), method.tracks_locally) << method.name << " " << name;
    for (const std::string name : {"kept_after_reduction", "first_reduction_time"})
      EXPECT_EQ(result.has(group + "/" + name), method.trackings_after_search > 0)
          << method.name << " " << name;
    EXPECT_EQ(result.has(group + "/second_tracking_time"), method.trackings_after_search > 1) << method.name;
    std::set<std::string> local, global;
    for (const CounterDescription& counter : method.local_counters()) local.insert(counter.name);
    for (const CounterDescription& counter : method.global_counters()) global.insert(counter.name);
    for (const MethodDescription& other : method_descriptions()) {
      for (const CounterDescription& counter : other.counters) {
        EXPECT_EQ(result.has(group + "/counters/" + counter.name), local.count(counter.name) > 0)
            << method.name << " " << counter.name;
        EXPECT_EQ(result.has(group + "/global_counters/" + counter.name), global.count(counter.name) > 0)
            << method.name << " " << counter.name;
      }
    }
  }
}

TEST(Run, ResultHasTheContractsShapes) {
  const ScratchDirectory scratch;
  run_to(scratch / "r.h5", short_shapes());
  const OpenResult result(scratch / "r.h5");
  const std::size_t N = 320, R = 2, G = 16, T = 15;
  using Shape = std::vector<std::size_t>;
  EXPECT_EQ(result.shape("/path/time"), (Shape{N}));
  EXPECT_EQ(result.shape("/path/orientation"), (Shape{N, 4}));
  EXPECT_EQ(result.shape("/scene/in_contact"), (Shape{N}));
  EXPECT_EQ(result.shape("/summary/frames_in_contact"), (Shape{1}));
  for (const std::string method : {"/methods/original", "/methods/improved"}) {
    EXPECT_EQ(result.shape(method + "/force"), (Shape{N, 3}));
    EXPECT_EQ(result.shape(method + "/torque"), (Shape{N, 3}));
    for (const std::string name :
         {"lmd_count", "lmd_count_before_reduction", "reduction_ratio", "minimum_distance", "lmd_age",
          "effective_stiffness", "force_clipped", "counters/tracking_steps"})
      EXPECT_EQ(result.shape(method + "/" + name), (Shape{N})) << name;
    EXPECT_EQ(result.shape(method + "/local_update_time"), (Shape{R, N}));
    EXPECT_EQ(result.shape(method + "/global_search_time"), (Shape{R, G}));
    for (const std::string name : {"global_frame", "candidates", "global_counters/node_pairs"})
      EXPECT_EQ(result.shape(method + "/" + name), (Shape{G})) << name;
    for (const std::string name :
         {"frame", "recall", "precision", "recall_adjacent", "precision_adjacent", "minimum_distance_error",
          "force_error", "force_angle_error", "force_jump"})
      EXPECT_EQ(result.shape(method + "/truth/" + name), (Shape{T})) << name;
    for (const SummaryNumber& number : summary_numbers())
      EXPECT_EQ(result.shape(method + "/summary/" + std::string(number.name)), (Shape{1})) << number.name;
    EXPECT_EQ(result.shape(method + "/lmds/frame_offset"), (Shape{N + 1}));
    const auto offsets = result.integers(method + "/lmds/frame_offset");
    EXPECT_EQ(result.shape(method + "/lmds/point_moving"),
              (Shape{static_cast<std::size_t>(offsets.back()), 3}));
  }
  for (const std::string name : {"first_reduction_time", "second_tracking_time"})
    EXPECT_EQ(result.shape("/methods/improved/" + name), (Shape{R, G})) << name;
  EXPECT_EQ(result.shape("/methods/improved/kept_after_reduction"), (Shape{G}));
  EXPECT_EQ(result.shape("/reference/force_linear"), (Shape{T, 3}));
  EXPECT_EQ(result.shape("/crosscheck/fcl/distance"), (Shape{7}));
  EXPECT_EQ(result.shape("/methods/improved/fcl/minimum_distance_difference_relative"), (Shape{7}));
  EXPECT_EQ(result.integer_attribute("/methods", "warm_up_repetitions"), 1);
  EXPECT_EQ(result.text_attribute("/methods/improved", "force_law"), "exponential");
  EXPECT_EQ(result.text_attribute("/methods/improved", "result_hash").size(), 16u);
  EXPECT_TRUE(result.has("/provenance/plan"));
  EXPECT_EQ(result.strings("/provenance/inputs/role"), std::vector<std::string>{"path"})
      << "shapes are generated";
  // Unset values are NaN.
  EXPECT_TRUE(std::isnan(result.doubles("/methods/improved/lmd_age")[0])) << "nothing has arrived in frame 0";
  EXPECT_DOUBLE_EQ(result.doubles("/methods/improved/lmd_age")[20], 0.02);
  EXPECT_TRUE(std::isnan(result.doubles("/methods/improved/minimum_distance")[0]));
  EXPECT_TRUE(std::isnan(result.doubles("/methods/improved/reduction_ratio")[0]));
  EXPECT_FALSE(std::isnan(result.doubles("/methods/improved/first_reduction_time")[0]));
}

TEST(Run, OnlyWhatTheSceneNeedsIsInTheResult) {
  const ScratchDirectory scratch;
  const Experiment bare = short_shapes(
      {"/record/lmds=false", "/probes/truth/stride_frames=0", "/probes/fcl/stride_frames=0", "/frames=50"});
  const RunResult run = run_to(scratch / "r.h5", bare);
  const OpenResult result(scratch / "r.h5");
  EXPECT_FALSE(result.has("/reference"));
  EXPECT_FALSE(result.has("/crosscheck"));
  EXPECT_FALSE(result.has("/methods/improved/truth"));
  EXPECT_FALSE(result.has("/methods/improved/lmds"));
  EXPECT_EQ(run.tracks[0].fcl(), nullptr);
  EXPECT_THAT(summary_text(summarise(bare, run)), HasSubstr("error  not measured"));
}

TEST(Run, EveryMethodRunsSideBySide) {
  const Experiment all =
      short_shapes({R"(/methods/-={"name":"certified","force_law":"exponential"})",
                    R"(/methods/-={"name":"exhaustive","force_law":"exponential"})", "/record/lmds=false"});
  const RunResult run = run_experiment(all);
  ASSERT_EQ(run.records.size(), 4u);
  EXPECT_EQ(run.records[2].result_hash, run.records[3].result_hash) << "certified is exact and complete";
  for (const TruthComparison& row : run.comparisons(3)) {
    EXPECT_EQ(row.force_error, 0.0);
    EXPECT_TRUE(std::isnan(row.same.recall()) || row.same.recall() == 1.0);
    EXPECT_TRUE(std::isnan(row.same.precision()) || row.same.precision() == 1.0);
  }
  const auto in_contact =
      std::count_if(run.tracks[0].truth()->frames.begin(), run.tracks[0].truth()->frames.end(),
                    [](const TruthFrame& frame) { return !frame.lmds.empty(); });
  EXPECT_GE(in_contact, 3) << "or the test above says nothing";
}

TEST(Run, InterruptionLeavesTheEarlierResultWhole) {
  const ScratchDirectory scratch;
  run_to(scratch / "r.h5", short_shapes());
  const auto before = deterministic_datasets(scratch / "r.h5");
  EXPECT_THROW(
      run_experiment_to_file(short_shapes({"/force/maximum_force_n=1"}), scratch / "r.h5", {},
                             [](const std::string&, std::int64_t done, std::int64_t) { return done < 200; }),
      Interrupted);
  EXPECT_TRUE(before == deterministic_datasets(scratch / "r.h5"));
}

TEST(Run, ProgressNamesItsPhases) {
  std::vector<std::string> phases;
  run_experiment(short_shapes(), [&](const std::string& phase, std::int64_t done, std::int64_t total) {
    EXPECT_LE(done, total);
    if (phases.empty() || phases.back() != phase) phases.push_back(phase);
    return true;
  });
  EXPECT_THAT(phases, ::testing::ElementsAre("run", "truth", "fcl"));
}

TEST(Run, OpenMeshGoesOnAndTheResultSaysSo) {
  const ScratchDirectory scratch;
  run_to(scratch / "r.h5", short_shapes({"/fixed/0/mesh=patch", "/frames=30"}));
  const OpenResult result(scratch / "r.h5");
  EXPECT_EQ(result.integer_attribute("/scene/fixed_0", "closed"), 0);
  EXPECT_EQ(result.integer_attribute("/scene/moving", "closed"), 1);
  EXPECT_THAT(result.strings("/scene/warnings"), Contains(HasSubstr("fixed_0 mesh patch: ")));
}

TEST(Run, StartInPenetrationGoesOnAndTheResultSaysSo) {
  const ScratchDirectory scratch;
  std::ofstream(scratch / "path.tum") << "0 0.08 0 0 0 0 0 1\n0.05 0.085 0 0 0 0 0 1\n";
  run_to(scratch / "r.h5",
         short_shapes({"/path/file=" + (scratch / "path.tum").string(), "/driver/search_every_frames=5",
                       "/driver/search_latency_frames=0"}));
  const OpenResult result(scratch / "r.h5");
  EXPECT_EQ(result.integer_attribute("/scene", "starts_touching"), 1);
  EXPECT_THAT(result.strings("/scene/warnings"), Contains(HasSubstr("touch in the first frame")));
  EXPECT_GT(result.doubles("/methods/improved/summary/frames_touching")[0], 0.0);
  for (const double force : result.doubles("/methods/improved/force")) EXPECT_TRUE(std::isfinite(force));
  for (const double force : result.doubles("/methods/original/force")) EXPECT_TRUE(std::isfinite(force));
}

/// A realtime recorder that has no room loses lists; the frame's count says how long they were.
TEST(Run, LostListsOfLmdsAreWrittenAsEmpty) {
  const ScratchDirectory scratch;
  run_to(scratch / "r.h5",
         short_shapes({"/driver/kind=realtime", "/driver/realtime/floor_s=0.01",
                       "/driver/realtime/lock_memory=false", "/driver/realtime/queue_ticks=16",
                       "/driver/realtime/plant/recorder_stall_s=0.2", "/frames=600", "/record/lmds=true",
                       R"(/methods=[{"name":"improved"}])", "/probes/truth/stride_frames=0"}));
  const OpenResult result(scratch / "r.h5");
  const std::vector<std::int64_t> offsets = result.integers("/methods/improved/lmds/frame_offset"),
                                  counts = result.integers("/methods/improved/lmd_count");
  ASSERT_EQ(offsets.size(), counts.size() + 1);
  std::size_t lost = 0;
  for (std::size_t frame = 0; frame < counts.size(); ++frame) {
    const std::int64_t rows = offsets[frame + 1] - offsets[frame];
    if (rows != counts[frame]) ++lost;
    EXPECT_TRUE(rows == counts[frame] || rows == 0) << frame;
  }
  EXPECT_GT(lost, 0U);
}

TEST(Run, PolylinesAreRecordedWhereTheyAreAskedFor) {
  const ScratchDirectory scratch;
  std::ofstream(scratch / "path.tum") << "0 0.2 0 0 0 0 0 1\n0.1 0.06 0 0 0 0 0 1\n";
  const std::vector<Override> overrides{"/path/file=" + (scratch / "path.tum").string(),
                                        "/driver/search_every_frames=5", "/driver/search_latency_frames=0"};
  run_to(scratch / "without.h5", short_shapes(overrides));
  EXPECT_FALSE(OpenResult(scratch / "without.h5").has("/polylines"));
  std::vector<Override> asked = overrides;
  asked.emplace_back("/record/polylines/stride_frames=10");
  const Experiment experiment = short_shapes(asked);
  EXPECT_TRUE(make_plan(experiment).needs("intersection polylines"));
  run_to(scratch / "with.h5", experiment);
  const OpenResult result(scratch / "with.h5");
  const std::vector<std::int64_t> frames = result.integers("/polylines/frame");
  const std::vector<std::int64_t> frame_offset = result.integers("/polylines/frame_offset");
  const std::vector<std::int64_t> point_offset = result.integers("/polylines/point_offset");
  ASSERT_EQ(frames.size(), 10u);
  ASSERT_EQ(frame_offset.size(), 11u);
  EXPECT_EQ(frame_offset[1], 0) << "apart at first";
  const auto lines = static_cast<std::size_t>(frame_offset.back());
  ASSERT_GT(lines, 0u);
  ASSERT_EQ(point_offset.size(), lines + 1);
  EXPECT_EQ(result.shape("/polylines/point"),
            (std::vector<std::size_t>{static_cast<std::size_t>(point_offset.back()), 3}));
  for (const std::uint8_t closed : result.bytes("/polylines/closed")) EXPECT_EQ(closed, 1);
  // The length is that of the polyline's points.
  const std::vector<double> point = result.doubles("/polylines/point");
  const auto at = [&](std::int64_t i) {
    return Vec3(Eigen::Map<const Vec3>(&point[3 * static_cast<std::size_t>(i)]));
  };
  double length = (at(0) - at(point_offset[1] - 1)).norm();
  for (std::int64_t i = 1; i < point_offset[1]; ++i) length += (at(i) - at(i - 1)).norm();
  EXPECT_NEAR(result.doubles("/polylines/length")[0], length, 1e-15);
}

TEST(Run, FixedPosesPlaceTheMeshInTheWorld) {
  // If path and fixed mesh turn by 90 degrees about z, the forces turn too.
  const ScratchDirectory scratch;
  std::ofstream(scratch / "a.tum") << "0 0.087 0 0 0 0 0 1\n0.1 0.084 0 0 0 0 0 1\n";
  std::ofstream(scratch / "b.tum") << "0 0.01 0.107 0 0 0 0.70710678118654752 0.70710678118654752\n"
                                   << "0.1 0.01 0.104 0 0 0 0.70710678118654752 0.70710678118654752\n";
  const auto overrides = [&](const std::string& path) {
    return std::vector<Override>{"/path/file=" + (scratch / path).string(), "/driver/search_every_frames=5",
                                 "/driver/search_latency_frames=0", "/force/cutoff_diagonal=0.2"};
  };
  std::vector<Override> turned = overrides("b.tum");
  turned.push_back("/fixed/0/pose/translation_m=[0.01,0.02,0]");
  turned.push_back("/fixed/0/pose/rotation_xyzw=[0,0,0.70710678118654752,0.70710678118654752]");
  const RunResult a = run_experiment(short_shapes(overrides("a.tum")));
  const RunResult b = run_experiment(short_shapes(turned));
  const Vec3 force_a = a.records[1].frames.back().force;
  const Vec3 force_b = b.records[1].frames.back().force;
  ASSERT_GT(force_a.norm(), 0.1);
  EXPECT_NEAR(force_b.y(), force_a.x(), 1e-6);
  EXPECT_NEAR(force_b.x(), -force_a.y(), 1e-6);
}

TEST(Run, ASinglePoseIsAPathOfOneFrame) {
  const ScratchDirectory scratch;
  std::ofstream(scratch / "path.tum") << "5 0.2 0 0 0 0 0 1\n";
  const RunResult run = run_experiment(short_shapes({"/path/file=" + (scratch / "path.tum").string()}));
  EXPECT_EQ(run.prepared.times, std::vector<double>{5.0});
  EXPECT_EQ(run.tracks[0].truth(), nullptr);
}

TEST(Prepare, RefusesWhatCannotBeUsed) {
  const ScratchDirectory scratch;
  std::ofstream(scratch / "long.tum") << "0 0.2 0 0 0 0 0 1\n1e12 0.2 0 0 0 0 0 1\n";
  const auto message = [](const std::vector<Override>& overrides) -> std::string {
    try {
      run_experiment(short_shapes(overrides));
    } catch (const Error& error) {
      return std::to_string(static_cast<int>(error.code())) + " " + error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message({"/path/file=" + (scratch / "long.tum").string(), "/frames=20000000"}),
              HasSubstr("lasts 1e+12 s"));
  EXPECT_THAT(message({"/moving/mesh=no-such-mesh"}), StartsWith("3 "));
  EXPECT_THAT(message({"/moving/mesh=./no/such.off"}), StartsWith("3 "));
  EXPECT_THAT(message({"/device=phantom-desk"}), StartsWith("2 "));
  EXPECT_THAT(message({R"(/force={"cutoff_diagonal":0.01,"saturation_m":0.5,"maximum_force_n":1})"}),
              HasSubstr("/force/saturation_m: saturation at 0.5 m"));
}

TEST(Summary, ShowsErrorsBesideTimes) {
  const Experiment experiment = short_shapes();
  const RunSummary summary = summarise(experiment, run_experiment(experiment));
  ASSERT_EQ(summary.methods.size(), 2u);
  EXPECT_EQ(summary.frames_probed, 15) << "from frame 20 on, where the first search arrives";
  EXPECT_GT(summary.frames_in_contact, 20);
  EXPECT_LT(summary.frames_in_contact, 320);
  const std::string text = summary_text(summary);
  ASSERT_THAT(text, HasSubstr("time   local update"));
  EXPECT_LT(text.find("error  recall"), text.find("time   local update"));
  EXPECT_THAT(text, HasSubstr("force error ")) << "a force alone would be taken for one";
}

/// `run`, `run --json` and the result file give the same numbers.
TEST(Summary, IsTheSameInTheFileAndInJson) {
  const ScratchDirectory scratch;
  const Experiment experiment = short_shapes();
  const RunSummary summary = summarise(experiment, run_to(scratch / "r.h5", experiment));
  const OpenResult result(scratch / "r.h5");
  const auto json = nlohmann::json::parse(summary_json(summary));
  for (std::size_t i = 0; i < summary.methods.size(); ++i) {
    const MethodSummary& method = summary.methods[i];
    for (const SummaryNumber& number : summary_numbers()) {
      const std::string name(number.name);
      const double value = method.*number.value;
      EXPECT_THAT(result.doubles("/methods/" + method.label + "/summary/" + name)[0],
                  ::testing::NanSensitiveDoubleEq(value))
          << name;
      const auto& in_json = json["methods"][i][name];
      if (std::isnan(value))
        EXPECT_TRUE(in_json.is_null()) << name;
      else
        EXPECT_EQ(in_json.get<double>(), value) << name;
    }
  }
  EXPECT_TRUE(json["methods"][0]["first_reduction_median_s"].is_null()) << "the original has none";
  EXPECT_TRUE(json["methods"][1]["first_reduction_median_s"].is_number());
  EXPECT_EQ(json["frames_in_contact"].get<double>(), result.doubles("/summary/frames_in_contact")[0]);
  EXPECT_EQ(json["fcl"]["frames"], 7);
  EXPECT_THAT(summary_text(summary),
              HasSubstr(fmt::format("recall {:.3g} ({:.3g})", summary.methods[1].recall,
                                    summary.methods[1].recall_adjacent)));
}

/// The number of jumps of each of these methods and of its truth.
std::map<std::string, std::pair<double, double>> jumps_of(const std::string& methods, std::string& label) {
  // So many frames that both laws have jumps, not equally many.
  const Experiment experiment = short_shapes({"/methods=" + methods, "/driver/repetitions=1", "/frames=640"});
  const RunSummary summary = summarise(experiment, run_experiment(experiment));
  label = summary.truth_of_every_frame;
  std::map<std::string, std::pair<double, double>> jumps;
  for (const MethodSummary& method : summary.methods) jumps[method.label] = {method.jumps, method.true_jumps};
  return jumps;
}

TEST(Summary, ACompleteSetThatRunsAlongIsTheTruthOfEveryFrame) {
  std::string label;
  const auto alone = jumps_of(R"([{"name":"improved","force_law":"exponential"}])", label);
  EXPECT_EQ(label, "") << "the probe's frames alone";
  const auto along = jumps_of(
      R"([{"name":"improved","force_law":"exponential"},{"name":"original","force_law":"linear"},
          {"name":"certified","force_law":"exponential"}])",
      label);
  EXPECT_EQ(label, "certified");
  EXPECT_EQ(along.at("certified").first, along.at("certified").second) << "no exact method invents jumps";
  EXPECT_EQ(along.at("improved").second, along.at("certified").first) << "one truth a law";
  EXPECT_EQ(along.at("improved").first, alone.at("improved").first);
  const auto linear = jumps_of(
      R"([{"name":"original","force_law":"linear"},{"name":"certified","force_law":"linear"}])", label);
  EXPECT_EQ(along.at("original").second, linear.at("certified").first) << "the other law of the same sets";
  EXPECT_NE(along.at("original").second, along.at("improved").second);
}

TEST(Summary, ForcesOfFramesInWhichTrianglesIntersectAreNotTheTruth) {
  const ScratchDirectory scratch;
  std::ofstream(scratch / "path.tum") << "0 0.12 0 0 0 0 0 1\n0.1 0.07 0 0 0 0 0 1\n";
  const Experiment experiment = short_shapes({"/path/file=" + (scratch / "path.tum").string(), "/frames=90",
                                              R"(/methods=[{"name":"certified","force_law":"linear"}])"});
  const RunResult run = run_experiment(experiment);
  ASSERT_TRUE(run.tracks[0].truth()->complete);
  const ForcesByLaw& forces = run.tracks[0].truth()->complete->force;
  std::size_t unknown = 0;
  for (std::size_t i = 0; i < run.records[0].frames.size(); ++i) {
    const bool intersects = run.records[0].frames[i].contact_without_direction > 0;
    unknown += intersects ? 1 : 0;
    for (const ForceLaw law : force_laws())
      EXPECT_EQ(forces[static_cast<std::size_t>(law)][i].hasNaN(), intersects) << i;
  }
  EXPECT_GT(unknown, 2u);
  const MethodSummary summary = summarise(experiment, run).methods[0];
  EXPECT_LT(summary.true_jump_frames, summary.frames_in_contact - 1.0);
  EXPECT_GT(summary.true_jump_frames, 0.0);
}

TEST(Summary, TextTellsCountsAndIntervals) {
  const Experiment experiment =
      short_shapes({R"(/methods/-={"name":"certified","force_law":"exponential"})"});
  const RunSummary summary = summarise(experiment, run_experiment(experiment));
  EXPECT_THAT(summary_text(summary),
              HasSubstr("against truth by exhaustive search and in all of them by certified"));
  EXPECT_THAT(summary_text(summary), HasSubstr(" (95 %: "));
  const auto json = nlohmann::json::parse(summary_json(summary));
  EXPECT_EQ(json["truth_of_every_frame"], "certified");
  EXPECT_EQ(json["frame_rate_hz"], 1000.0);
}

TEST(Summary, EachNumberIsNamedOnceWithItsUnit) {
  std::set<std::string_view> names;
  for (const SummaryNumber& number : summary_numbers()) {
    EXPECT_TRUE(names.insert(number.name).second) << number.name;
    EXPECT_FALSE(number.long_name.empty()) << number.name;
    for (const auto& [ending, units] : {std::pair{"_n", "N"}, {"_s", "s"}, {"_m", "m"}, {"_rad", "rad"}})
      EXPECT_EQ(number.name.ends_with(ending) && !number.name.ends_with("_n_per_m"), number.units == units)
          << number.name;
  }
}

}  // namespace
}  // namespace lmdbench
