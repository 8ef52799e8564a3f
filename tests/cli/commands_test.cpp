// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/shapes.h>
#include <lmdbench/cli/examples.h>

#include "program.h"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <support/source_directory.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

const std::string SHORT_RUN = SHAPES + "--set /frames=60 --set /driver/repetitions=2 ";

std::vector<nlohmann::json> json_lines(const std::string& text) {
  std::vector<nlohmann::json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

TEST(Program, HelpAndVersionGoToStandardOutput) {
  for (const std::string command : {"--help", "run --help", "plan --help", "query --help"}) {
    const Outcome help = lmdbench(command);
    EXPECT_EQ(help.code, 0) << command;
    EXPECT_THAT(help.out, HasSubstr("Usage: ")) << command;
    EXPECT_THAT(help.err, IsEmpty()) << command;
    EXPECT_THAT(help.out, HasSubstr("\nExamples:\n  lmdbench ")) << command;
    EXPECT_THAT(help.out, HasSubstr("\nExit codes: 0 done;")) << command;
  }
  const Outcome version = lmdbench("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.out, StartsWith("lmdbench "));
}

TEST(RunCommand, WritesAResultFromAnyDirectory) {
  const ScratchDirectory scratch;
  const Outcome outcome = lmdbench("run " + SHORT_RUN, scratch.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(scratch / "results/shapes.h5")) << "the default place";
  EXPECT_THAT(outcome.out, StartsWith("shapes: 60 frames"));
  EXPECT_THAT(outcome.out, HasSubstr("method    recall  force error, RMS  time a frame"));
  EXPECT_LE(std::ranges::count(outcome.out, '\n'), 6) << "a line a method\n" << outcome.out;
  EXPECT_THAT(outcome.err, HasSubstr("wrote results/shapes.h5; "));
  EXPECT_THAT(outcome.err, HasSubstr("lmdbench report results/shapes.h5 --out results/shapes\n"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("ETA"))) << "no bar off a terminal";
  EXPECT_THAT(outcome.err, Not(HasSubstr("\x1b"))) << "no colours off a terminal";
}

TEST(RunCommand, JsonSummaryIsOneDocument) {
  const ScratchDirectory scratch;
  const Outcome outcome =
      lmdbench("run " + SHORT_RUN + "--json -q --out '" + (scratch / "r.h5").string() + "'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["frames"], 60);
  EXPECT_EQ(json["methods"][1]["label"], "improved");
  EXPECT_THAT(outcome.err, IsEmpty()) << "-q tells errors only";
}

TEST(Program, QuietTellsErrorsAlone) {
  const ScratchDirectory scratch;
  for (const std::string& line :
       {"-q run " + SHORT_RUN + "--out r.h5", "run " + SHORT_RUN + "--out r.h5 --quiet",
        std::string("-q init cube wedge --dir '" LMDBENCH_SOURCE_DIR "/meshes' --out new"),
        std::string("-q path generate new/cube-wedge.path.json --dir '" LMDBENCH_SOURCE_DIR
                    "/meshes' --out p.tum")}) {
    const Outcome outcome = lmdbench(line, scratch.path());
    EXPECT_EQ(outcome.code, 0) << line << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty()) << line;
    EXPECT_THAT(outcome.err, IsEmpty()) << line;
  }
  EXPECT_TRUE(std::filesystem::exists(scratch / "r.h5"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "p.tum"));
  const Outcome broken =
      lmdbench("-q run " + SHORT_RUN + "--out r.h5 --set /limits/recall=1.5", scratch.path());
  EXPECT_EQ(broken.code, USAGE);
  EXPECT_THAT(broken.err, HasSubstr("/limits/recall"));
}

TEST(PathCommand, RepeatsThePathThatInitMakesFarFromTheOrigin) {
  const ScratchDirectory scratch;
  TriangleMesh box = make_box({0.02, 0.02, 0.02});
  for (Vec3& vertex : box.vertices) vertex += Vec3(131072.0, 0.0, 0.0);
  for (const char* name : {"a.off", "b.off"}) scratch.write(name, to_off_text(box));
  EXPECT_EQ(lmdbench("init a.off b.off --out new", scratch.path()).code, 0);
  const Outcome outcome = lmdbench("path generate new/a-b.path.json --out p.tum", scratch.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST(PathCommand, CountsFramesAboutTheWantedGapFromThePathsBegin) {
  const ScratchDirectory scratch;
  scratch.write("ball.off", to_off_text(make_sphere(1.0, 2)));
  const double diagonal = bounding_box_diagonal(make_sphere(1.0, 2));
  const std::string spec = R"({"moving": {"mesh": "./ball.off"}, "fixed": {"mesh": "./ball.off"},
    "frame_rate_hz": 4, "seed": 1, "start_direction": [1, 0, 0], "slide_rate_deg_per_s": 1,
    "turn_rate_deg_per_s": 1, "gap_floor": 0.0001, "gaps": [{"time_s": 0, "gap": 0.1}, {"time_s": 1, "gap": )";
  scratch.write("s.json", spec + "0.1}]}");
  const auto at_wanted_gap = [&](double gap, int code) {
    const double x = 2.0 + gap * diagonal;
    scratch.write("p.tum", fmt::format("10 {0} 0 0 0 0 0 1\n11 {0} 0 0 0 0 0 1\n", x));
    const Outcome outcome = lmdbench("path info p.tum --spec s.json --json", scratch.path());
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return nlohmann::json::parse(outcome.out)["frames_at_wanted_gap"].get<int>();
  };
  EXPECT_EQ(at_wanted_gap(0.1, 0), 5);
  EXPECT_EQ(at_wanted_gap(0.05, 0), 0) << "far too near";
  EXPECT_EQ(at_wanted_gap(-0.05, 1), 0) << "they intersect";
  EXPECT_EQ(at_wanted_gap(0.2, 0), 0);
  scratch.write("s.json", spec + "0.5}]}");
  EXPECT_EQ(at_wanted_gap(0.1, 0), 1) << "the first frame alone, at time 10";
}

TEST(PathCommand, APathOfTwoFramesHasNoAcceleration) {
  const ScratchDirectory scratch;
  scratch.write("p.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
  for (const char* rate : {"0.5", "1"}) {
    const Outcome outcome = lmdbench(std::string("path info p.tum --rate ") + rate, scratch.path());
    EXPECT_THAT(outcome.out, AllOf(Not(HasSubstr("nan")), HasSubstr("shorter than two frames")))
        << outcome.out;
  }
  EXPECT_THAT(lmdbench("path info p.tum --rate 2", scratch.path()).out, HasSubstr("at most 1 m/s"));
}

class StopSignals : public ::testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(StopSignals, EndTheRunByTheSignalKeepWhatWasMeasuredAndTheEarlierResult) {
  const auto [name, number] = GetParam();
  const ScratchDirectory scratch;
  const std::string result = (scratch / "r.h5").string();
  ASSERT_EQ(lmdbench("run " + SHORT_RUN + "--out '" + result + "'").code, 0);
  const std::string earlier = read_text(result);
  const std::string run = "run " + SHAPES + "--set /driver/repetitions=1000 --out '" + result + "'";
  // The part file grows from a few kilobytes to its full size just before the first frame runs.
  const Outcome outcome =
      lmdbench(run + " & pid=$!; until [ -e '" + result + ".part' ] && [ $(stat -c %s '" + result +
               ".part') -gt 100000 ]; do kill -0 $pid || exit; sleep 0.05; done; sleep 0.3; kill -" + name +
               " $pid; wait $pid; echo $?");
  EXPECT_EQ(outcome.out, std::to_string(128 + number) + "\n") << "a shell's number for the signal";
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("interrupted: "), HasSubstr("r.h5.part keeps what was measured"),
                                 HasSubstr("--resume")));
  EXPECT_EQ(read_text(result), earlier);
  const std::string part = read_text(result + ".part");
  const Outcome again = lmdbench(run);
  EXPECT_EQ(again.code, 4);
  EXPECT_THAT(again.err,
              AllOf(HasSubstr("r.h5.part: holds what an interrupted run measured"), HasSubstr("--resume")));
  EXPECT_EQ(read_text(result + ".part"), part) << "nothing measured is lost by mistake";
  const Outcome compared = lmdbench("compare '" + result + ".part' '" + result + "'");
  EXPECT_EQ(compared.code, 3);
  EXPECT_THAT(compared.err, HasSubstr("--resume")) << "no reader takes a part for a result";
}

INSTANTIATE_TEST_SUITE_P(RunCommand, StopSignals,
                         ::testing::Values(std::pair{"INT", 2}, std::pair{"TERM", 15}, std::pair{"HUP", 1}));

TEST(PlanCommand, JsonAndText) {
  const Outcome text = lmdbench("plan " + SHAPES);
  EXPECT_EQ(text.code, 0);
  EXPECT_THAT(text.out, HasSubstr("left out:\n"));
  const Outcome json = lmdbench("plan --json " + SHAPES + "--set /probes/fcl/stride_frames=0");
  EXPECT_EQ(json.code, 0);
  const auto plan = nlohmann::json::parse(json.out);
  EXPECT_EQ(plan["experiment"]["probes"]["fcl"]["stride_frames"], 0);
  bool left_out = false;
  for (const auto& item : plan["left_out"]) left_out = left_out || item["part"] == "FCL cross-check";
  EXPECT_TRUE(left_out);
}

TEST(PlanCommand, FailsAsARunDoesOnWhatIsNotThere) {
  for (const std::string fault : {"/device=phantom-dektop", "/path/file=nowhere.tum",
                                  "/moving/mesh=./nowhere.stl", "/fixed/0/mesh=nomesh"}) {
    const Outcome plan = lmdbench("plan " + SHAPES + "--set " + fault);
    const Outcome run = lmdbench("run " + SHORT_RUN + "--set " + fault + " --out /tmp/never.h5");
    EXPECT_NE(plan.code, 0) << fault;
    EXPECT_EQ(plan.code, run.code) << fault;
    EXPECT_EQ(plan.err, run.err) << fault;
  }
}

TEST(PlanCommand, LooksAtTheScene) {
  const auto plan =
      nlohmann::json::parse(lmdbench("plan --json " + SHAPES + "--set /force/cutoff_diagonal=1e-9").out);
  EXPECT_EQ(plan["scene"]["frames"], 801);
  EXPECT_EQ(plan["scene"]["warnings"].size(), 1u);
  EXPECT_TRUE(plan["scene"]["expected_seconds"].contains("improved"));
}

TEST(RunCommand, BrokenLimitsEndWithOneAndKeepTheResult) {
  const ScratchDirectory scratch;
  const std::string out = " --out '" + (scratch / "r.h5").string() + "' ";
  EXPECT_EQ(lmdbench("run " + SHAPES + "--set /frames=320 --set /driver/repetitions=1" + out +
                     "--set /limits/force_error_n=1000")
                .code,
            0);
  const Outcome broken = lmdbench("run " + SHAPES + "--set /frames=320 --set /driver/repetitions=1" + out +
                                  "--set /limits/recall=1");
  EXPECT_EQ(broken.code, 1);
  EXPECT_THAT(broken.err, HasSubstr("/limits: "));
  EXPECT_THAT(broken.out, HasSubstr("limit broken: original: recall is"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "r.h5"));
}

TEST(WorkPrecisionCommand, FailedPointsEndWithOne) {
  const ScratchDirectory scratch;
  scratch.write("sweep.json", R"({"name": "s", "experiments": [")" + SHAPES_FILE + R"("], "repetitions": 1,
      "truth_check_frames": 1, "set": {"/frames": 30}, "series": [{"method": {"name": "certified"},
      "axes": [{"/moving/mesh": ["blob", "./missing.off"]}]}]})");
  for (const std::string more : {"", "--points 0-1"}) {
    const Outcome outcome = lmdbench("-q work-precision sweep.json --out s.h5 " + more, scratch.path());
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("missing.off"), HasSubstr("no numbers")));
  }
  EXPECT_EQ(lmdbench("work-precision sweep.json --out s.h5 --points 0", scratch.path()).code, 0);
  EXPECT_THAT(lmdbench("work-precision sweep.json --out s.h5 --points ''", scratch.path()).err,
              HasSubstr("no list of points"));
  const Outcome list =
      lmdbench("--limit file-bytes=1000000 work-precision sweep.json --out s.h5 --list", scratch.path());
  EXPECT_EQ(list.code, 0) << "the program is no input: " << list.err;
}

TEST(AnatomyCommand, TellsTimesOfAClockInFull) {
  const ScratchDirectory scratch;
  const std::string path =
      scratch.write("p.tum", "1700000000.25 0 0 1 0 0 0 1\n1700000001.5 0 0 1 0 0 0 1\n");
  EXPECT_THAT(lmdbench("anatomy " + SHAPES + "--time 0.4 --set /path/file=" + path).err,
              HasSubstr("0.4 s is no time of the path (remedy: give one from 1700000000.25 to 1700000001."));
}

TEST(InitCommand, WritesAnExperimentThatRuns) {
  const ScratchDirectory scratch;
  const Outcome made =
      lmdbench("init cube wedge --dir '" LMDBENCH_SOURCE_DIR "/meshes' --out new", scratch.path());
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("/force/cutoff_m"));
  const Outcome run = lmdbench("run new/cube-wedge.json --set /driver/repetitions=1", scratch.path());
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, Not(HasSubstr("never comes")));
  const Outcome path = lmdbench(
      "path info new/cube-wedge.tum --spec new/cube-wedge.path.json --dir '" LMDBENCH_SOURCE_DIR "/meshes'",
      scratch.path());
  EXPECT_EQ(path.code, 0) << path.err;
  EXPECT_EQ(lmdbench("init cube wedge --dir '" LMDBENCH_SOURCE_DIR "/meshes' --out new", scratch.path()).code,
            2);
}

constexpr const char* BOX_IN_MILLIMETRES =
    "OFF\n8 12 0\n0 0 0\n40 0 0\n40 60 0\n0 60 0\n0 0 20\n40 0 20\n40 60 20\n0 60 20\n"
    "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 "
    "4 7\n";

TEST(InitCommand, UnlikeUnitsNeedAWord) {
  const ScratchDirectory scratch;
  scratch.write("box.off", BOX_IN_MILLIMETRES);
  scratch.write(
      "metres.off",
      "OFF\n8 12 0\n0 0 0\n.04 0 0\n.04 .06 0\n0 .06 0\n0 0 .02\n.04 0 .02\n.04 .06 .02\n0 .06 .02\n"
      "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n"
      "3 3 4 7\n");
  const Outcome refused = lmdbench("init box.off metres.off --out new", scratch.path());
  EXPECT_EQ(refused.code, USAGE);
  EXPECT_THAT(refused.err, HasSubstr("--unit mm,m"));
  const Outcome taken = lmdbench("init box.off metres.off --out new --unit mm,m", scratch.path());
  EXPECT_EQ(taken.code, 0) << taken.err;
  const Outcome unlike = lmdbench("init box.off metres.off --out other --unit m,m", scratch.path());
  EXPECT_THAT(unlike.err, AllOf(HasSubstr("1000 times as much"), Not(HasSubstr("says no unit"))));
}

TEST(InitCommand, ContactsAreReadyForStability) {
  const ScratchDirectory scratch;
  scratch.write("box.off", BOX_IN_MILLIMETRES);
  const Outcome made = lmdbench("init box.off box.off --contact --out new", scratch.path());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("lmdbench stability new"));
  const Outcome found =
      lmdbench(R"(stability new/box-box-contact.json --json --set '/methods=[{"name": "certified"}]')",
               scratch.path());
  EXPECT_EQ(found.code, 0) << found.err;
  EXPECT_GT(nlohmann::json::parse(found.out)[0]["critical_stiffness_n_per_m"].get<double>(), 0.0);
}

TEST(StabilityCommand, NoAnswerIsItsOwnExitCodeWithARemedy) {
  const std::string wall = "stability '" LMDBENCH_SOURCE_DIR "/experiments/wall.json' --json ";
  struct Case {
    const char* settings;
    const char* outcome;
    const char* remedy;
  };
  for (const Case& c :
       {Case{"--set /loop/friction_n=0.1", "stuck", "/loop/push_n of more than 0.8 N"},
        {"--set /force/cutoff_m=0.001", "no_contact", "init --contact"},
        {"--set /force/saturation_m=0.01999 --set '/loop/push_n=[0,0,0]'", "saturated", "saturation_m"},
        {"--set /loop/damping_n_s_per_m=0", "never", "more damping"},
        {"--trials 2", "undecided", "raise --seconds or --trials"}}) {
    const Outcome outcome = lmdbench(wall + c.settings);
    EXPECT_EQ(outcome.code, INPUT_DATA) << c.settings;
    const auto rows = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(rows[0]["clean_until"], c.outcome);
    EXPECT_THAT(outcome.err, HasSubstr(c.remedy));
  }
  EXPECT_EQ(lmdbench(wall).code, 0);
  const Outcome table = lmdbench("stability '" LMDBENCH_SOURCE_DIR "/experiments/wall.json'");
  EXPECT_THAT(table.out, AllOf(HasSubstr("certified"), HasSubstr("clean")));
}

TEST(MeshCommand, SaysWhereAMeshCrossesItselfAndIsInsideOut) {
  const ScratchDirectory scratch;
  // Two tetrahedra that cross; the second one is inside out.
  scratch.write("cross.off",
                "OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n.1 .1 .1\n1.1 .1 .1\n.1 1.1 .1\n.1 .1 1.1\n"
                "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 4 6 5\n3 4 5 7\n3 4 7 6\n3 5 6 7\n");
  scratch.write("turned.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n");
  const Outcome cross = lmdbench("mesh info cross.off --json", scratch.path());
  EXPECT_GT(nlohmann::json::parse(cross.out)["self_intersections"]["pairs"].get<int>(), 0);
  const Outcome turned = lmdbench("mesh info turned.off", scratch.path());
  EXPECT_THAT(turned.out, HasSubstr("crosses self  none"));
  EXPECT_THAT(turned.out, HasSubstr("--orient outward"));
}

/// A prism whose walls are cut in two and whose ends have the corners of both.
TEST(MeshCommand, JudgesAMeshAsARunTakesIt) {
  const ScratchDirectory scratch;
  scratch.write("p.obj",
                "v 0 0 0\nv 5 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 0 0 5\nv 5 0 5\nv 10 0 5\nv 10 10 5\n"
                "v 0 10 5\nf 5 4 3\nf 5 3 1\nf 3 2 1\nf 6 7 8 9 10\nf 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\nf 4 5 "
                "10 9\nf 5 1 6 10\n");
  const Outcome info = lmdbench("mesh info p.obj", scratch.path());
  EXPECT_THAT(info.out, AllOf(HasSubstr("crosses self  none"), Not(HasSubstr("finding")),
                              HasSubstr("repairs       1 flat triangle, ")));
  const Outcome made = lmdbench("init p.obj p.obj --out new", scratch.path());
  EXPECT_THAT(made.err, Not(HasSubstr("touch or cross"))) << made.err;
}

TEST(InitCommand, LooksAtItsFolderFirstAndQuotesIt) {
  const ScratchDirectory scratch;
  scratch.write("box.off", to_off_text(make_box({0.04, 0.06, 0.02})));
  const Outcome refused = lmdbench("init box.off box.off --out box.off/new", scratch.path());
  EXPECT_EQ(refused.code, ENVIRONMENT);
  EXPECT_THAT(refused.err, HasSubstr("box.off is a file (remedy: name another folder with --out)"));
  std::filesystem::create_directory(scratch / "my parts");
  const std::filesystem::path link = scratch / "my parts" / "box-box.tum";
  std::filesystem::create_symlink("nowhere.tum", link);
  EXPECT_EQ(lmdbench("init box.off box.off --out 'my parts'", scratch.path()).code, USAGE);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  std::filesystem::remove(link);
  EXPECT_THAT(lmdbench("init box.off box.off --out 'my parts'", scratch.path()).out,
              HasSubstr("lmdbench run 'my parts/box-box.json'\n"));
}

/// Two unit cubes; the moving one stands above the fixed one by the pose's z - 1.
class QueryCommand : public ::testing::Test {
 protected:
  std::string cube() const {
    return scratch_.write("cube.off",
                          "OFF\n8 12 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                          "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n"
                          "3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n");
  }
  ScratchDirectory scratch_;
};

TEST_F(QueryCommand, TakesUnitsAndTurnsWhatIsInsideOut) {
  const std::string mesh = cube();
  std::string turned = read_text(mesh);
  turned = turned.substr(0, turned.find("3 0 2 1")) +
           "3 0 1 2\n3 0 2 3\n3 4 6 5\n3 4 7 6\n3 0 5 1\n3 0 4 5\n3 1 6 2\n3 1 5 6\n3 2 7 3\n3 2 6 7\n3 3 4 "
           "0\n3 3 7 4\n";
  const std::string inside_out = scratch_.write("turned.off", turned);
  const std::string pose = scratch_.write("p.tum", "0 0 0 0.00125 0 0 0 1\n");
  const auto found = [&](const std::string& moving, const std::string& more) {
    const Outcome outcome = lmdbench("query --moving '" + moving + "' --fixed '" + mesh +
                                     "' --cutoff 0.0005 --json --poses '" + pose + "' " + more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json_lines(outcome.out).at(0);
  };
  EXPECT_NEAR(found(mesh, "--unit mm")["minimum_distance"].get<double>(), 0.00025, 1e-12)
      << "answers stay in metres";
  EXPECT_NEAR(found(mesh, "--unit 0.001,mm")["minimum_distance"].get<double>(), 0.00025, 1e-12);
  EXPECT_TRUE(found(inside_out, "--unit mm")["lmds"].empty());
  EXPECT_EQ(found(inside_out, "--unit mm --orient outward")["lmds"], found(mesh, "--unit mm")["lmds"]);
  EXPECT_EQ(lmdbench("query --moving '" + mesh + "' --fixed '" + mesh + "' --cutoff 1 --unit mile").code,
            USAGE);
  const Outcome large =
      lmdbench("query --moving '" + mesh + "' --fixed '" + mesh + "' --cutoff 1 --unit 1e200");
  EXPECT_EQ(large.code, INPUT_DATA);
  EXPECT_THAT(large.err, HasSubstr("cube.off: --unit 1e200: "));
  EXPECT_THAT(lmdbench("query --moving '" + mesh + "' --fixed '" + mesh +
                       "' --cutoff 1 --option kernel=scalar --option kernel=scalar")
                  .err,
              HasSubstr("kernel is given twice"));
}

TEST_F(QueryCommand, PrintsALineAPoseInWorldCoordinates) {
  // The moving cube is turned by 45 degrees about x: its edge hangs over the fixed upper face.
  const std::string poses =
      scratch_.write("p.tum", "1 0.25 0.5 1.01 0.3826834323650898 0 0 0.9238795325112867\n2 0 0 5 0 0 0 1\n");
  const std::string mesh = cube();
  for (const std::string method : {"exhaustive", "certified", "improved"}) {
    const Outcome outcome =
        lmdbench("query --moving '" + mesh + "' --fixed '" + mesh + "' --cutoff 0.05 --json --method " +
                 method + " --poses '" + poses + "'");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto lines = json_lines(outcome.out);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0]["time"], 1.0);
    EXPECT_EQ(lines[0]["method"], method);
    EXPECT_NEAR(lines[0]["minimum_distance"].get<double>(), 0.01, 1e-12) << method;
    ASSERT_GE(lines[0]["lmds"].size(), 1u) << method;
    const auto& lmd = lines[0]["lmds"][0];
    EXPECT_NEAR(lmd["point_fixed"][2].get<double>(), 1.0, 1e-12) << method;
    EXPECT_NEAR(lmd["point_moving"][2].get<double>(), 1.01, 1e-12) << method;
    EXPECT_TRUE(lmd["feature_moving"]["index"].is_number_integer());
    EXPECT_TRUE(lines[1]["minimum_distance"].is_null());
    EXPECT_TRUE(lines[1]["lmds"].empty());
  }
}

TEST_F(QueryCommand, CriticalPairsAreOfMethodsThatFindThem) {
  const std::string meshes =
      "query --moving '" + cube() + "' --fixed '" + cube() + "' --cutoff 0.5 --critical";
  const Outcome refused = lmdbench(meshes + " --method improved");
  EXPECT_EQ(refused.code, USAGE);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("--critical"), HasSubstr("finds LMDs alone")));
  EXPECT_EQ(lmdbench(meshes + " --json").code, 0);
}

TEST_F(QueryCommand, ReadsPosesFromStandardInput) {
  const std::string mesh = cube();
  const Outcome outcome =
      lmdbench("query --moving '" + mesh + "' --fixed '" + mesh +
               "' --cutoff 0.5 --json --poses - <<END\n0 0 0 1.25 0 0 0 1\n3 0 0 1.125 0 0 0 1\nEND\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto lines = json_lines(outcome.out);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0]["minimum_distance"], 0.25);
  EXPECT_EQ(lines[1]["minimum_distance"], 0.125);
}

TEST_F(QueryCommand, IdentityPoseWithoutPoses) {
  const std::string mesh = cube();
  const Outcome outcome =
      lmdbench("query --moving '" + mesh + "' --fixed '" + mesh + "' --cutoff 0.5 --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto lines = json_lines(outcome.out);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0]["time"], 0.0);
  EXPECT_EQ(lines[0]["minimum_distance"], 0.0) << "the cube touches its copy";
  EXPECT_EQ(lines[0]["method"], "certified");
}

TEST_F(QueryCommand, TextIsForPeople) {
  const std::string mesh = cube();
  const Outcome outcome =
      lmdbench("query --moving '" + mesh + "' --fixed '" + mesh + "' --cutoff 0.5 --method exhaustive");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("exhaustive: "));
}

}  // namespace
}  // namespace lmdbench::testing
