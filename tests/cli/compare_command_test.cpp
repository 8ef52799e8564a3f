// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include "program.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <nlohmann/json.hpp>
#include <support/source_directory.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace lmdbench::testing {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

const std::string RUN = "run '" LMDBENCH_SOURCE_DIR
                        "/experiments/shapes.json' --set /frames=60 --set /driver/repetitions=3 "
                        "--set /probes/truth/stride_frames=20 --set /probes/fcl/stride_frames=0 ";

/// Replaces one element of a dataset of a result, as a change of the program might.
void plant(const std::filesystem::path& file, const char* dataset, hsize_t at, hid_t type,
           const void* value) {
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Adelete(id, "content_sha256");  // The file is changed on purpose.
  const hid_t data = H5Dopen2(id, dataset, H5P_DEFAULT);
  const hid_t space = H5Dget_space(data);
  const hsize_t one = 1;
  const hid_t memory = H5Screate_simple(1, &one, nullptr);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, &at, nullptr, &one, nullptr);
  ASSERT_GE(H5Dwrite(data, type, memory, space, H5P_DEFAULT, value), 0);
  H5Sclose(memory);
  H5Sclose(space);
  H5Dclose(data);
  H5Fclose(id);
}

/// Multiplies the times of all repetitions, as a slower build would.
void slow_down(const std::filesystem::path& file, const char* dataset, double factor, double seconds_more) {
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Adelete(id, "content_sha256");  // The file is changed on purpose.
  const hid_t data = H5Dopen2(id, dataset, H5P_DEFAULT);
  const hid_t space = H5Dget_space(data);
  std::vector<double> times(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  ASSERT_GE(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, times.data()), 0);
  for (double& time : times) time = factor * time + seconds_more;
  ASSERT_GE(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, times.data()), 0);
  H5Sclose(space);
  H5Dclose(data);
  H5Fclose(id);
}

class CompareCommand : public ::testing::Test {
 public:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<ScratchDirectory>();
    ASSERT_EQ(lmdbench(RUN + "--out a.h5", scratch_->path()).code, 0);
    ASSERT_EQ(lmdbench(RUN + "--out b.h5", scratch_->path()).code, 0);
  }
  static void TearDownTestSuite() { scratch_.reset(); }
  /// A copy of the second run, to be changed.
  static std::filesystem::path copy(const std::string& name) {
    std::filesystem::copy_file(*scratch_ / "b.h5", *scratch_ / name);
    return *scratch_ / name;
  }
  /// `--base` or `--candidate` with six copies of the second run whose times a factor lengthens.
  static std::string processes(const std::string& side, const std::string& name, double factor,
                               double spread) {
    std::string files = " --" + side;
    for (int i = 0; i < 6; ++i) {
      const std::string file = name + std::to_string(i) + ".h5";
      slow_down(copy(file), "/methods/improved/global_search_time",
                factor * (1.0 + spread * (i + (side == "base" ? 0.0 : 0.5))), 0.0);
      files += " " + file;
    }
    return files;
  }
  static Outcome compare(const std::string& arguments) {
    return lmdbench("compare " + arguments, scratch_->path());
  }

  static std::unique_ptr<ScratchDirectory> scratch_;
};
std::unique_ptr<ScratchDirectory> CompareCommand::scratch_;

TEST_F(CompareCommand, TwoRunsOfOneExperimentAreSameOrUnsure) {
  const Outcome outcome = compare("a.h5 b.h5 --json");
  EXPECT_THAT(outcome.code, AnyOf(0, 4)) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(json["differences"].empty());
  EXPECT_EQ(json["timings"].size(), 6U) << "original: search and local update; improved: all four";
}

TEST_F(CompareCommand, OrderOfMethodsDoesNotMatter) {
  ASSERT_EQ(lmdbench(RUN + "--set '/methods=[{\"name\":\"improved\",\"force_law\":\"exponential\"},"
                           "{\"name\":\"original\",\"force_law\":\"linear\"}]' --out swapped.h5",
                     scratch_->path())
                .code,
            0);
  const Outcome outcome = compare("a.h5 swapped.h5 --json");
  EXPECT_THAT(outcome.code, AnyOf(0, 4)) << outcome.out;
  EXPECT_TRUE(nlohmann::json::parse(outcome.out)["differences"].empty());
}

TEST_F(CompareCommand, PlantedBehaviourIsNamed) {
  const std::filesystem::path file = copy("planted.h5");
  const std::int64_t lost = 77;
  plant(file, "/methods/improved/lmd_count", 41, H5T_NATIVE_INT64, &lost);
  const Outcome outcome = compare("a.h5 planted.h5 --json --junit junit.xml");
  EXPECT_EQ(outcome.code, 1);
  const auto difference = nlohmann::json::parse(outcome.out)["differences"][0];
  EXPECT_EQ(difference["method"], "improved");
  EXPECT_EQ(difference["dataset"], "lmd_count");
  EXPECT_EQ(difference["frame"], 41);
  EXPECT_EQ(difference["candidate"], 77);
  EXPECT_THAT(compare("a.h5 planted.h5").out, HasSubstr("improved: lmd_count differs in frame 41: "));
  EXPECT_THAT(compare("a.h5 planted.h5 --markdown").out, HasSubstr("| improved | `lmd_count` | 41 |"));
  EXPECT_THAT(read_text(*scratch_ / "junit.xml"), HasSubstr("<failure type=\"changed\""));
}

TEST_F(CompareCommand, EveryVerdictOnTimesHasItsExitCode) {
  const std::string base = processes("base", "base", 1.0, 0.001);
  const Outcome same = compare(base + processes("candidate", "same", 1.0, 0.001));
  EXPECT_EQ(same.code, 0) << same.out;
  EXPECT_THAT(same.out, HasSubstr("same: "));
  const std::string slow = processes("candidate", "slow", 3.0, 0.001);
  const Outcome slower = compare(base + slow + " --json");
  EXPECT_EQ(slower.code, 1);
  const auto json = nlohmann::json::parse(slower.out);
  EXPECT_EQ(json["verdict"], "slower");
  for (const auto& timing : json["timings"])
    EXPECT_EQ(timing["verdict"],
              timing["method"] == "improved" && timing["stage"] == "search" ? "slower" : "same");
  const Outcome faster = compare(base + processes("candidate", "fast", 0.5, 0.001));
  EXPECT_EQ(faster.code, 0);
  EXPECT_THAT(faster.out, HasSubstr("faster: "));
  const std::string doubtful = processes("candidate", "doubtful", 0.9, 0.05);
  const Outcome unsure = compare(base + doubtful);
  EXPECT_EQ(unsure.code, 4);
  EXPECT_THAT(unsure.out, HasSubstr("unsure: "));
  EXPECT_EQ(compare(base + doubtful + " --threshold 0.4").code, 0);
}

TEST_F(CompareCommand, OneProcessASideIsUnsureHoweverItsTimesLie) {
  slow_down(copy("alone.h5"), "/methods/improved/global_search_time", 8.1, 1e-3);
  for (const std::string files : {"b.h5 alone.h5", "alone.h5 b.h5", "a.h5 b.h5", "b.h5 b.h5"}) {
    const Outcome outcome = compare(files);
    EXPECT_EQ(outcome.code, 4) << files;
    EXPECT_THAT(outcome.out, HasSubstr("one process a side cannot judge times")) << files;
    EXPECT_THAT(outcome.out, HasSubstr("unknown")) << "no interval is claimed";
  }
}

TEST_F(CompareCommand, TwoForceLawsAreCompared) {
  const std::string run = RUN + "--set '/methods=[{\"name\":\"certified\",\"force_law\":\"linear\"}]' ";
  ASSERT_EQ(lmdbench(run + "--out sum.h5", scratch_->path()).code, 0);
  ASSERT_EQ(lmdbench(run + "--set /force/aggregation=shared --out shared.h5", scratch_->path()).code, 0);
  const Outcome outcome = compare("sum.h5 shared.h5 --json");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["differences"][0]["dataset"], "/provenance/experiment:/force/aggregation");
  EXPECT_EQ(json["differences"][0]["candidate"], "shared");
  EXPECT_EQ(json["timings"].size(), 1U);
}

TEST_F(CompareCommand, OtherFramesAndSweepsAreRefusedInOneLine) {
  ASSERT_EQ(lmdbench(RUN + "--set /frames=50 --out other.h5", scratch_->path()).code, 0);
  const Outcome other = compare("a.h5 other.h5");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("/frames"));
  EXPECT_EQ(std::count(other.err.begin(), other.err.end(), '\n'), 1) << other.err;
  EXPECT_EQ(other.out, "");
  std::ofstream(*scratch_ / "sweep.json")
      << R"({"name": "s", "title": "a sweep", "experiments": [")" LMDBENCH_SOURCE_DIR
         R"(/experiments/shapes.json"], "repetitions": 1, "truth_check_frames": 1, "set": {"/frames": 60},
             "series": [{"method": {"name": "certified", "force_law": "linear"}}]})";
  ASSERT_EQ(lmdbench("work-precision sweep.json --out sweep.h5", scratch_->path()).code, 0);
  for (const std::string files : {"a.h5 sweep.h5", "sweep.h5 a.h5"}) {
    const Outcome sweep = compare(files);
    EXPECT_EQ(sweep.code, 2) << files;
    EXPECT_THAT(sweep.err, HasSubstr("a sweep of lmdbench work-precision")) << files;
  }
  const Outcome drawn = lmdbench("export sweep.h5 --out drawn", scratch_->path());
  EXPECT_EQ(drawn.code, 2);
  EXPECT_THAT(drawn.err, HasSubstr("a sweep of lmdbench work-precision"));
}

TEST_F(CompareCommand, ReportsReplaceNothingButTheirOwn) {
  std::ofstream(*scratch_ / "notes.txt") << "mine";
  for (const std::string option : {"--junit", "--benchmark", "--benchmark-base"}) {
    for (const std::string file : {"notes.txt", "a.h5"}) {
      const Outcome outcome = compare("a.h5 b.h5 " + option + " " + file);
      EXPECT_EQ(outcome.code, 2) << option << " " << file;
      EXPECT_THAT(outcome.err, HasSubstr(file)) << option;
    }
    for (int times = 0; times < 2; ++times)
      EXPECT_THAT(compare("a.h5 b.h5 " + option + " own" + option).code, AnyOf(0, 4)) << option << times;
  }
  const Outcome twice = compare("a.h5 b.h5 --junit both --benchmark ./both");
  EXPECT_EQ(twice.code, 2);
  EXPECT_THAT(twice.err, HasSubstr("two outputs"));
  EXPECT_EQ(std::filesystem::file_size(*scratch_ / "notes.txt"), 4U);
  EXPECT_THAT(compare("a.h5 b.h5").code, AnyOf(0, 4)) << "both are results still";
}

TEST_F(CompareCommand, FalseAlarmsShareTheProbabilityGiven) {
  EXPECT_EQ(compare("a.h5 b.h5 --false-alarm 0.2").code, 2) << "above the error of the interval";
  EXPECT_THAT(compare("a.h5 b.h5 --false-alarm 0.05").code, AnyOf(0, 4));
}

TEST_F(CompareCommand, LateFramesAreATimeAndNoBehaviour) {
  const std::filesystem::path late = copy("late.h5");
  const double many = 17.0;
  plant(late, "/methods/improved/summary/frames_late", 0, H5T_NATIVE_DOUBLE, &many);
  const Outcome outcome = compare("a.h5 late.h5 --json");
  EXPECT_TRUE(nlohmann::json::parse(outcome.out)["differences"].empty()) << outcome.out;
}

TEST_F(CompareCommand, CountersCanBeAllowed) {
  const std::filesystem::path file = copy("counter.h5");
  const std::int64_t more = 123456;
  plant(file, "/methods/original/global_counters/node_pairs", 1, H5T_NATIVE_INT64, &more);
  const Outcome changed = compare("a.h5 counter.h5 --json");
  EXPECT_EQ(changed.code, 1);
  EXPECT_EQ(nlohmann::json::parse(changed.out)["differences"][0]["dataset"], "global_counters/node_pairs");
  EXPECT_EQ(nlohmann::json::parse(changed.out)["differences"][0]["frame"], 20);
  EXPECT_THAT(compare("a.h5 counter.h5 --allow node_pairs").code, AnyOf(0, 4));
  const Outcome unknown = compare("a.h5 counter.h5 --allow node_pear");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("node_pairs"));
}

TEST_F(CompareCommand, AFileThatIsNoResult) {
  std::ofstream(*scratch_ / "text.h5") << "no HDF5";
  for (const std::string arguments : {"a.h5 text.h5", "absent.h5 a.h5", "--base a.h5 --candidate text.h5"}) {
    const Outcome outcome = compare(arguments);
    EXPECT_EQ(outcome.code, 3) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr("remedy: ")) << arguments;
  }
}

TEST_F(CompareCommand, WrongUsage) {
  for (const std::string arguments :
       {"", "a.h5", "a.h5 b.h5 --base a.h5", "--base a.h5", "--candidate a.h5", "a.h5 b.h5 --threshold -1",
        "--base a.h5 a.h5 --candidate b.h5", "a.h5 b.h5 --threshold nan", "a.h5 b.h5 --false-alarm NaN",
        "a.h5 b.h5 --tolerance -nan"})
    EXPECT_EQ(compare(arguments).code, 2) << arguments;
}

TEST_F(CompareCommand, BenchmarkFilesHoldBothSides) {
  const Outcome outcome = compare("a.h5 b.h5 --benchmark b.json --benchmark-base a.json");
  EXPECT_THAT(outcome.code, AnyOf(0, 4));
  for (const char* name : {"a.json", "b.json"}) {
    const auto json = nlohmann::json::parse(read_text(*scratch_ / name));
    EXPECT_EQ(json["benchmarks"].size(), 6U);
    EXPECT_GT(json["benchmarks"][0]["real_time"].get<double>(), 0.0);
  }
}

TEST(DoctorCommand, NamesEveryFindingAndTheNoise) {
  const Outcome outcome = lmdbench("doctor --json");
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_GE(json["findings"].size(), 10U);
  const bool bad = std::any_of(json["findings"].begin(), json["findings"].end(),
                               [](const nlohmann::json& finding) { return finding["health"] == "bad"; });
  EXPECT_EQ(outcome.code, bad ? 1 : 0) << outcome.err;
  for (const auto& finding : json["findings"])
    EXPECT_EQ(finding["health"] == "good", finding["remedy"].get<std::string>().empty()) << finding.dump();
  EXPECT_GT(json["noise"]["spread"].get<double>(), 0.0);
  EXPECT_GT(json["noise"]["detectable"].get<double>(), 0.0);
  EXPECT_NEAR(json["noise"]["seconds"].get<double>(), 5.0, 1.5)
      << "of pieces; on a busy machine the last group is longer";
}

}  // namespace
}  // namespace lmdbench::testing
