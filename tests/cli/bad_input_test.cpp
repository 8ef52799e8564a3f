// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "program.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/source_directory.h>

#include <string>
#include <vector>

/// Errors that users make, through the real program: it must give the exit code and a message that
/// names file and place.
namespace lmdbench::testing {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class BadInput : public ::testing::Test {
 protected:
  /// Runs the shapes experiment with this change; it must fail and leave no result.
  Outcome run_with(const std::string& options) {
    const Outcome outcome =
        lmdbench("run " + SHAPES + options + " --out '" + (scratch_ / "r.h5").string() + "'");
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "r.h5"));
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "r.h5.part"));
    EXPECT_THAT(outcome.err, HasSubstr("remedy: "));
    return outcome;
  }
  Outcome run_path(const std::string& text) {
    return run_with("--set '/path/file=" + scratch_.write("path.tum", text) + "'");
  }
  Outcome run_mesh(const std::string& name, const std::string& text) {
    return run_with("--set '/moving/mesh=" + scratch_.write(name, text) + "'");
  }

  ScratchDirectory scratch_;
};

TEST_F(BadInput, BrokenJson) {
  const Outcome outcome = lmdbench("run '" + scratch_.write("broken.json", "{\n \"name\": }") + "'");
  EXPECT_EQ(outcome.code, USAGE);
  EXPECT_THAT(outcome.err, HasSubstr("broken.json: line 2, column 10: not JSON"));
}

TEST_F(BadInput, MissingExperiment) {
  const Outcome outcome = lmdbench("run /no/such/experiment.json");
  EXPECT_EQ(outcome.code, USAGE);
  EXPECT_THAT(outcome.err, HasSubstr("/no/such/experiment.json: cannot read"));
}

struct Refused {
  std::string options;
  int code;
  std::vector<const char*> said;
};

TEST_F(BadInput, ValuesAndFilesOfAnExperiment) {
  for (const auto& [options, code, said] : std::vector<Refused>{
           {"--set /force/cutof_diagonal=0.1",
            USAGE,
            {"shapes.json: /force/cutof_diagonal: unknown key", "did you mean \"cutoff_diagonal\"?"}},
           {"--set /force/cutoff_diagonal=0", USAGE, {"/force/cutoff_diagonal: ", "found 0"}},
           {"--set /force/cutoff_diagonal=-0.01", USAGE, {"/force/cutoff_diagonal: ", "found -0.01"}},
           {"--set /force/maximum_force_n=nan", USAGE, {"/force/maximum_force_n: "}},
           {"--set /methods/0/name=orginal", USAGE, {"/methods/0/"}},
           {"--driver sundial", USAGE, {"/driver/kind: "}},
           {"--driver lockstep --require-realtime", USAGE, {"shapes.json: /driver/kind: ", "two drivers"}},
           {"--driver lockstep --set /driver/kind=realtime", USAGE, {"/driver/kind: ", "two drivers"}},
           {"--set /device=phantom-9000", USAGE, {"shapes.json: /device: ", "phantom-desktop"}},
           {"--set /moving/mesh=no-such-mesh", INPUT_DATA, {"manifest.json", "no-such-mesh"}},
           {"--set /moving/mesh=./no-such.off", INPUT_DATA, {"no-such.off"}},
           {"--set /path/file=./no-such.tum", INPUT_DATA, {"no-such.tum"}}}) {
    SCOPED_TRACE(options);
    const Outcome outcome = run_with(options);
    EXPECT_EQ(outcome.code, code);
    for (const char* words : said) EXPECT_THAT(outcome.err, HasSubstr(words));
  }
}

TEST_F(BadInput, PathsThatNothingCanFollow) {
  for (const auto& [path, code, said] : std::vector<Refused>{
           {"0 0 0 0.2 0 0 0 1\n1 0 nan 0.2 0 0 0 1\n", INPUT_DATA, {"path.tum: line 2"}},
           {"0 0 0 0.2 0 0 0 1\n1 0 0 0.2 0 0 0 1\n0.5 0 0 0.2 0 0 0 1\n", INPUT_DATA, {"path.tum: line 3"}},
           {"0 0 0 0.2 0 0 0 2\n", INPUT_DATA, {"path.tum: line 1"}},
           {"# nothing\n", INPUT_DATA, {"path.tum"}}}) {
    SCOPED_TRACE(path);
    const Outcome outcome = run_path(path);
    EXPECT_EQ(outcome.code, code);
    EXPECT_THAT(outcome.err, HasSubstr(said.front()));
  }
}

TEST_F(BadInput, BrokenMeshFiles) {
  EXPECT_EQ(run_mesh("text.off", "this is no mesh").code, INPUT_DATA);
  EXPECT_EQ(run_mesh("empty.off", "OFF\n0 0 0\n").code, INPUT_DATA);
  EXPECT_EQ(run_mesh("index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n").code, INPUT_DATA);
  EXPECT_EQ(run_mesh("nan.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n").code, INPUT_DATA);
  EXPECT_EQ(run_mesh("point.off", "OFF\n3 1 0\n1 1 1\n1 1 1\n1 1 1\n3 0 1 2\n").code, INPUT_DATA)
      << "no extent";
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  const Outcome outcome = lmdbench("run " + SHAPES + "--set /frames=30 --out /proc/no/r.h5");
  EXPECT_EQ(outcome.code, ENVIRONMENT);
  EXPECT_THAT(outcome.err, HasSubstr("/proc/no"));
}

TEST_F(BadInput, StandardOutputIsNoPlaceForFiles) {
  for (const std::string& line :
       {"run " + SHAPES + "--set /frames=30 --out -",
        std::string("record '" LMDBENCH_SOURCE_DIR "/experiments/wall.json' -o -"),
        std::string("work-precision '" LMDBENCH_SOURCE_DIR "/experiments/sweeps/budget.json' --out -")}) {
    const Outcome outcome = lmdbench(line, scratch_.path());
    EXPECT_EQ(outcome.code, USAGE) << line;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("\"-\" stands for standard output"),
                                   HasSubstr("(remedy: name a file with --out")));
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "-")) << line;
  }
}

TEST_F(BadInput, AnEmptyNameIsNoDefault) {
  ASSERT_EQ(lmdbench("run " + SHAPES + "--set /frames=30 --out r.h5", scratch_.path()).code, 0);
  for (const std::string& line :
       {"run " + SHAPES + "--set /frames=30", std::string("export r.h5"), std::string("report r.h5"),
        std::string("init cube wedge --dir '" LMDBENCH_SOURCE_DIR "/meshes'"),
        std::string("work-precision '" LMDBENCH_SOURCE_DIR "/experiments/sweeps/quick.json'")}) {
    const Outcome outcome = lmdbench(line + " --out ''", scratch_.path());
    EXPECT_EQ(outcome.code, USAGE) << line;
    EXPECT_THAT(outcome.err, ContainsRegex("--out: names no f(ile|older)")) << line;
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch_.path()), {}), 1) << "the result alone";
}

TEST_F(BadInput, RecordedPathsReplaceNothingButTheirOwn) {
  const std::string record = "record '" LMDBENCH_SOURCE_DIR "/experiments/wall.json' --set /frames=30 --out ";
  const std::string notes = scratch_.write("notes.tum", "0 0 0 0 0 0 0 1\n");
  const Outcome refused = lmdbench(record + notes, scratch_.path());
  EXPECT_EQ(refused.code, USAGE);
  EXPECT_THAT(refused.err, HasSubstr("notes.tum"));
  for (int times = 0; times < 2; ++times)
    EXPECT_EQ(lmdbench(record + "own.tum", scratch_.path()).code, 0) << times;
}

TEST_F(BadInput, MisspeltCommandsAndOptionsAreNamedWithTheNearest) {
  struct Case {
    const char* line;
    const char* problem;
    const char* remedy;
  };
  for (const Case& c :
       {Case{"", "lmdbench needs a command", "the commands are run, plan, "},
        {"rn x.json --out r.h5", "lmdbench has no command \"rn\"", "did you mean \"run\"?"},
        {"dance", "lmdbench has no command \"dance\"", "the commands are run, plan, "},
        {"run --otu x", "lmdbench run has no option --otu", "did you mean \"--out\"?"},
        {"run x.json --otu=x", "lmdbench run has no option --otu", "did you mean \"--out\"?"},
        {"run x.json --verbos", "lmdbench run has no option --verbos", "did you mean \"--verbose\"?"},
        {"run x.json --no-such-option", "lmdbench run has no option --no-such-option", "lmdbench run --help"},
        {"query --moving a --fixd b --cutoff 1", "has no option --fixd", "did you mean \"--fixed\"?"},
        {"--limt a=1 plan x.json", "has no option --limt", "did you mean \"--limit\"?"},
        {"mesh", "lmdbench mesh needs a command", "the commands are "},
        {"mesh bild bunny", "lmdbench mesh has no command \"bild\"", "did you mean \"build\"?"},
        {"path info x.tum --sepc y", "lmdbench path info has no option --sepc", "did you mean \"--spec\"?"},
        {"run a.json b.json", "lmdbench run takes no further argument \"b.json\"", "lmdbench run --help"},
        {"query --moving a --fixed b", "--cutoff is required", "lmdbench query --help"}}) {
    const Outcome outcome = lmdbench(c.line);
    EXPECT_EQ(outcome.code, USAGE) << c.line;
    EXPECT_THAT(outcome.out, IsEmpty()) << c.line;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(c.problem), HasSubstr("(remedy: "), HasSubstr(c.remedy)))
        << c.line;
  }
}

TEST_F(BadInput, CommandLine) {
  EXPECT_EQ(lmdbench("run").code, USAGE);
  EXPECT_EQ(lmdbench("query --moving sphere --fixed sphere --cutoff 0").code, USAGE);
  EXPECT_EQ(lmdbench("query --moving sphere --fixed sphere --cutoff -1").code, USAGE);
  EXPECT_EQ(lmdbench("query --moving sphere --fixed sphere --cutoff nan").code, USAGE);
  EXPECT_EQ(lmdbench("query --moving sphere --fixed sphere --cutoff 0.1 --method magic").code, USAGE);
  EXPECT_EQ(lmdbench("query --moving sphere --fixed sphere --cutoff 0.1 --planar-tolerance wide").code,
            USAGE);
  EXPECT_EQ(lmdbench("query --moving sphere --fixed no-such-mesh --cutoff 0.1").code, INPUT_DATA);
  EXPECT_THAT(lmdbench("work-precision x.json --points 0 --json").err, HasSubstr("excludes"));
  EXPECT_THAT(lmdbench("export r.h5 --out v --frames 0").err, HasSubstr("0 not in range 1 to 2147483647"));
}

TEST_F(BadInput, NonManifoldMeshGoesOnWithAWarning) {
  // Three triangles share one edge, above the torus.
  const std::string fins = scratch_.write(
      "fins.off", "OFF\n5 3 0\n0 0 0\n1 0 0\n0.5 1 0\n0.5 0 1\n0.5 -1 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n");
  const std::string out = (scratch_ / "r.h5").string();
  const Outcome outcome =
      lmdbench("run " + SHAPES + "--set /frames=30 --set '/moving/mesh=" + fins + "' --out '" + out + "'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("note: moving mesh")) << "once, in the table";
  EXPECT_TRUE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace lmdbench::testing
