// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/sanitizers.h>
#include <lmdbench/result_file/result_reader.h>

#include <cli/program.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <result_file/result_reading.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace lmdbench::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string FOLDER = PLUGIN_FOLDER "/";
/// Plugins that load, with the mark that each gets.
const std::map<std::string, std::string> KINDS{{"crash", "frames_lost"},
                                               {"hang", "frames_lost"},
                                               {"leak", "frames_lost"},
                                               {"write_past_end", "frames_lost"},
                                               {"not_a_number", "contacts_not_finite"},
                                               {"unsorted", "answers_unsorted"},
                                               {"fast_math", "float_mode_changed"},
                                               {"too_many", "answers_too_large"},
                                               {"throws", "frames_lost"},
                                               {"exits", "frames_lost"},
                                               {"nan_force", "forces_wrong"},
                                               {"no_force", "forces_wrong"}};

/// 40 frames of the shapes experiment.
const std::string RUN =
    "run " + SHAPES +
    "--json --set /frames=40 --set /driver/repetitions=2 --set /driver/block_frames=10 "
    "--set /probes/truth/stride_frames=20 --set /probes/fcl/stride_frames=0 --set "
    "/force/cutoff_diagonal=0.15 "
    "--set '/methods=[{\"name\":\"original\"},{\"name\":\"improved\"},{\"name\":\"certified\"}]' --limit "
    "plugin-seconds=1 ";

const std::string TETRAHEDRON =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

class HostilePlugins : public ::testing::Test {
 protected:
  nlohmann::json run(const std::string& plugins, const std::string& out) {
    const Outcome outcome = lmdbench(RUN + plugins + " --out '" + (scratch_ / out).string() + "'");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
  }
  static std::map<std::string, nlohmann::json> by_label(const nlohmann::json& summary) {
    std::map<std::string, nlohmann::json> methods;
    for (const auto& method : summary.at("methods")) methods[method.at("label")] = method;
    return methods;
  }
  ScratchDirectory scratch_;
};

TEST_F(HostilePlugins, LoseNoResultAndMarkTheirFrames) {
  const auto alone = by_label(run("", "alone.h5"));
  std::string plugins = "--plugin " + FOLDER + "good.so --plugin " + FOLDER + "wrong_promise.so";
  for (const auto& [name, mark] : KINDS) plugins += " --plugin " + FOLDER + name + ".so";
  const nlohmann::json summary = run(plugins, "all.h5");
  const auto all = by_label(summary);
  ASSERT_EQ(all.size(), alone.size() + KINDS.size() + 2);
  for (const auto& [label, method] : alone)
    EXPECT_EQ(method.at("result_hash"), all.at(label).at("result_hash")) << label;

  const ResultReader result(scratch_ / "all.h5");
  const ResultReader before(scratch_ / "alone.h5");
  for (const auto& [label, method] : alone)
    for (const std::string dataset : {"force", "lmd_count", "truth/recall", "truth/force_error"})
      EXPECT_THAT(result.reals("/methods/" + label + "/" + dataset),
                  ::testing::Pointwise(::testing::NanSensitiveDoubleEq(),
                                       before.reals("/methods/" + label + "/" + dataset)))
          << label << " " << dataset;
  const auto marks = [&](const std::string& method, const std::string& mark) {
    const std::vector<std::int64_t> frames = result.integers("/methods/" + method + "/counters/" + mark);
    return std::accumulate(frames.begin(), frames.end(), std::int64_t{0});
  };
  for (const auto& [name, mark] : KINDS) {
    // Builds with sanitizers have no limit on memory.
    const bool must_fail = !IS_SANITIZED || name != "leak";
    EXPECT_GE(marks(name, mark), must_fail ? 1 : 0) << name;
    EXPECT_LE(marks(name, mark), 40) << name;
    EXPECT_EQ(marks("good", mark), 0) << name;
    if (mark != "frames_lost") {
      EXPECT_EQ(marks(name, "frames_lost"), 0) << name;
    }
    EXPECT_GT(all.at(name).at("local_update_median_s").get<double>(), 0.0)
        << name << " is timed all the same";
  }
  const std::vector<std::int64_t> lost = result.integers("/methods/crash/counters/frames_lost");
  const std::vector<double> times = result.reals("/methods/crash/local_update_time");
  for (std::size_t frame = 0; frame < lost.size(); ++frame)
    EXPECT_EQ(std::isnan(times[frame]), lost[frame] > 0) << frame << ": without an answer there is no time";
  // Three good frames and a lost one, four times; after that it is not started again.
  EXPECT_EQ(marks("crash", "frames_lost"), 40 - 4 * 2);
  std::string notes;
  for (const auto& note : summary.at("warnings")) notes += note.get<std::string>() + "\n";
  EXPECT_THAT(notes, AllOf(HasSubstr("crashed (Segmentation fault)"), HasSubstr("gave no answer within 1 s"),
                           HasSubstr("threw an exception"), HasSubstr("ended its process with status 0"),
                           HasSubstr("wrong_promise breaks its promise (complete-set)"),
                           HasSubstr("good, from outside: ")));
  EXPECT_FALSE(summary.at("truth_of_every_frame").is_null());
  EXPECT_EQ(summary.at("truth_of_every_frame"), "certified") << "not what an outsider says is complete";
  EXPECT_EQ(result.reals("/methods/good/way_time").size(), 80U);
  EXPECT_EQ(
      lmdbench("report '" + (scratch_ / "all.h5").string() + "' --out '" + (scratch_ / "page").string() + "'")
          .code,
      0)
      << "without the plugins";
  EXPECT_EQ(
      lmdbench("export '" + (scratch_ / "all.h5").string() + "' --out '" + (scratch_ / "view").string() + "'")
          .code,
      0);
  EXPECT_EQ(
      lmdbench("compare '" + (scratch_ / "all.h5").string() + "' '" + (scratch_ / "all.h5").string() + "'")
          .err,
      "");
}

/// A plugin's own force is rendered, recorded and compared; a set without a promise is not judged.
TEST_F(HostilePlugins, OwnForcesAreJudgedAsForces) {
  const auto methods = by_label(
      run("--plugin " + FOLDER + "pushes.so --plugin " + FOLDER + "no_force.so --set /record/torque=true",
          "forces.h5"));
  const ResultReader result(scratch_ / "forces.h5");
  const std::vector<double> force = result.reals("/methods/pushes/force");
  ASSERT_EQ(force.size(), 3U * 40U);
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_EQ(force[i], i % 3 == 2 ? 2.0 : 0.0) << i;
  const std::vector<double> torque = result.reals("/methods/pushes/torque"),
                            lost = result.reals("/methods/no_force/force"),
                            errors = result.reals("/methods/pushes/truth/force_error");
  EXPECT_NE(torque[0], 0.0);
  EXPECT_EQ(lost[3 * 1 + 2], 2.0);
  EXPECT_EQ(lost[3 * 2 + 2], 0.0) << "the third call gives none";
  const std::vector<double> truth = result.reals("/methods/certified/force");
  const std::vector<std::int64_t> probed = result.integers("/reference/frame");
  ASSERT_FALSE(probed.empty());
  ASSERT_EQ(errors.size(), probed.size());
  for (std::size_t i = 0; i < probed.size(); ++i) {
    const auto at = static_cast<std::size_t>(3 * probed[i]);
    EXPECT_NEAR(errors[i], std::hypot(truth[at], truth[at + 1], truth[at + 2] - 2.0), 1e-12);
  }
  EXPECT_TRUE(methods.at("pushes").at("recall").is_null());
  EXPECT_TRUE(methods.at("pushes").at("frames_wrong").is_null());
  EXPECT_GT(methods.at("pushes").at("force_error_rms_n").get<double>(), 0.0);
}

TEST_F(HostilePlugins, AreRefusedAtTheDoorWhereTheyCannotBeLoaded) {
  const Outcome abi = lmdbench("plan " + SHAPES + "--plugin " + FOLDER + "wrong_abi.so");
  EXPECT_EQ(abi.code, INPUT_DATA);
  EXPECT_THAT(abi.err, AllOf(HasSubstr("wrong_abi.so"), HasSubstr("version 99.1"),
                             HasSubstr("build it with this program's header")));
  const Outcome promise = lmdbench("plan " + SHAPES + "--plugin " + FOLDER + "no_promise.so");
  EXPECT_EQ(promise.code, INPUT_DATA);
  EXPECT_THAT(promise.err, HasSubstr("promises a force and has none"));
  const Outcome schema = lmdbench("plan " + SHAPES + "--plugin " + FOLDER + "endless_schema.so");
  EXPECT_EQ(schema.code, INPUT_DATA);
  EXPECT_THAT(schema.err, HasSubstr("refer to another schema"));
  const Outcome table = lmdbench("plan " + SHAPES + "--plugin " + FOLDER + "endless_table.so");
  EXPECT_EQ(table.code, INPUT_DATA);
  EXPECT_THAT(table.err, HasSubstr("has more than 64 methods"));
  const Outcome none = lmdbench("plan " + SHAPES + "--plugin missing.so");
  EXPECT_EQ(none.code, INPUT_DATA);
  EXPECT_THAT(none.err, HasSubstr("missing.so"));
  const Outcome other = lmdbench("plan " + SHAPES + "--plugin '" + SHAPES_FILE + "'");
  EXPECT_EQ(other.code, INPUT_DATA);
  EXPECT_THAT(
      lmdbench("plan " + SHAPES + "--plugin " + FOLDER + "good.so --plugin " + FOLDER + "good.so").err,
      HasSubstr("there is a method \"good\" already"));
  const Outcome twice = lmdbench("plan " + SHAPES + "--plugin " + FOLDER + "twice.so");
  EXPECT_EQ(twice.code, INPUT_DATA);
  EXPECT_THAT(twice.err, HasSubstr("there is a method \"twice\" already"));
}

TEST_F(HostilePlugins, AreFoundByTheCheck) {
  EXPECT_THAT(lmdbench("plugin check " + FOLDER + "good.so").out,
              HasSubstr("passed  good: same again, backwards, shuffled"));
  const Outcome pushes = lmdbench("plugin check " + FOLDER + "pushes.so");
  EXPECT_EQ(pushes.code, 0) << pushes.out;
  EXPECT_THAT(pushes.out, AllOf(HasSubstr("passed  pushes: gives its force"), HasSubstr("no set is judged")));
  const std::string of_write = IS_SANITIZED ? "ended its process" : "crashed";
  const std::map<std::string, std::string> said{{"crash", "search 3: crashed"},
                                                {"write_past_end", of_write},
                                                {"not_a_number", "are not finite"},
                                                {"too_many", "answers too large"},
                                                {"fast_math", "link without -ffast-math"},
                                                {"wrong_promise", "complete-set: recall"},
                                                {"exits", "ended its process"},
                                                {"nan_force", "forces not finite or not given"},
                                                {"no_force", "forces not finite or not given"}};
  for (const auto& [name, words] : said) {
    const Outcome outcome = lmdbench("plugin check " + FOLDER + name + ".so");
    EXPECT_EQ(outcome.code, 1) << name << outcome.out;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("failed"), HasSubstr(words))) << name;
  }
}

TEST_F(HostilePlugins, MayBeTrustedAndLeaveTheFloatModeAsItWas) {
  const std::string no_truth = "--set /probes/truth/stride_frames=0 ";
  const auto alone = by_label(run(no_truth, "alone.h5"));
  const auto beside = by_label(
      run(no_truth + "--trusted-plugin " + FOLDER + "fast_math.so --trusted-plugin " + FOLDER + "throws.so",
          "trusted.h5"));
  for (const auto& [label, method] : alone)
    EXPECT_EQ(method.at("result_hash"), beside.at(label).at("result_hash")) << label;
  const ResultReader result(scratch_ / "trusted.h5");
  EXPECT_EQ(result.integers("/methods/fast_math/counters/float_mode_changed").front(), 1)
      << "its constructor";
  EXPECT_EQ(result.integers("/methods/throws/counters/frames_lost").at(2), 1);
}

TEST_F(HostilePlugins, LostFramesAreKnownToAResumedRun) {
  const std::string file = (scratch_ / "r.h5").string();
  setenv("LMDBENCH_STOPPED", (scratch_ / "stopped").c_str(), 1);
  const std::string command = RUN + "--plugin " + FOLDER + "stops.so --out '" + file + "' --resume";
  EXPECT_EQ(lmdbench(command).code, 128 + SIGINT) << "a shell's number for the signal";
  const std::string dataset = "/methods/stops/local_update_time";
  const std::vector<double> before = OpenResult(file + ".part").doubles(dataset);
  EXPECT_EQ(lmdbench(command).code, 0);
  unsetenv("LMDBENCH_STOPPED");
  const std::vector<double> after = OpenResult(file).doubles(dataset);
  int kept = 0, lost = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (std::isnan(before[i])) continue;
    ++kept;
    lost += before[i] < 0.0 ? 1 : 0;
    if (before[i] < 0.0)
      EXPECT_TRUE(std::isnan(after[i])) << "frame " << i << " was lost";
    else
      EXPECT_EQ(before[i], after[i]) << "frame " << i;
  }
  EXPECT_GE(kept, 20);
  EXPECT_GE(lost, 3);
}

TEST_F(HostilePlugins, ASuspendedJobIsNoLateAnswer) {
  std::ofstream(scratch_ / "tetra.off") << TETRAHEDRON;
  std::string poses;
  for (int i = 0; i < 8; ++i) poses += std::to_string(i) + " 2 0 0 0 0 0 1\n";
  std::ofstream(scratch_ / "poses.tum") << poses;
  // The program goes on first: its plugin cannot have answered.
  const Outcome outcome =
      lmdbench("query --moving tetra.off --fixed tetra.off --cutoff 2 --poses poses.tum --plugin " + FOLDER +
                   "slow.so --method slow --limit plugin-seconds=2 & p=$!; sleep 1.2; c=$(cat "
                   "/proc/$p/task/$p/children); "
                   "kill -STOP $p $c; sleep 2.5; kill -CONT $p; sleep 0.3; kill -CONT $c; wait $p",
               scratch_.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(HostilePlugins, QuerySaysWhatWasLost) {
  std::ofstream(scratch_ / "tetra.off") << TETRAHEDRON;
  std::ofstream(scratch_ / "poses.tum")
      << "0 2 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n2 2 0 0 0 0 0 1\n3 2 0 0 0 0 0 1\n";
  const auto query = [&](const std::string& name) {
    return lmdbench("query --moving tetra.off --fixed tetra.off --cutoff 2 --poses poses.tum --plugin " +
                        FOLDER + name + ".so --method " + name,
                    scratch_.path());
  };
  const Outcome throws = query("throws");
  EXPECT_EQ(throws.code, 1) << "its empty set is no answer";
  EXPECT_THAT(throws.err, HasSubstr("throws, from outside: 1 "));
  EXPECT_THAT(throws.err, HasSubstr("the last one: "));
  EXPECT_EQ(query("good").code, 0);
  EXPECT_THAT(query("good").err, Not(HasSubstr("the last one")));
}

}  // namespace
}  // namespace lmdbench::testing
