// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/result_file/result_reader.h>
#include <lmdbench/sweep/run_sweep.h>
#include <lmdbench/sweep/write_sweep.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <result_file/result_reading.h>
#include <support/files.h>
#include <sweep/small_sweep.h>

#include <cmath>
#include <filesystem>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::OpenResult;
using testing::ScratchDirectory;

class RunSweep : public ::testing::Test {
 protected:
  Sweep loaded(const std::string& of_certified = "", int frames = 400, const std::string& keys = "") {
    return load_sweep(scratch_.write("sweep.json", testing::small_sweep(frames, 4, of_certified, keys)));
  }
  SweepResult run(const Sweep& sweep) {
    return run_sweep_to_file(sweep, scratch_ / "out.h5", {"lmdbench", "work-precision"});
  }
  ScratchDirectory scratch_;
};

TEST_F(RunSweep, PutsErrorBesideTimeForEveryPoint) {
  const Sweep sweep = loaded();
  const SweepResult result = run(sweep);
  const OpenResult file(scratch_ / "out.h5");
  EXPECT_THAT(file.strings("/points/series"), ElementsAre("improved", "improved", "certified"));
  EXPECT_THAT(file.strings("/points/failure"), ElementsAre("", "", ""));
  const std::vector<double> recall = file.doubles("/points/recall");
  const std::vector<double> force = file.doubles("/points/force_error_rms_n");
  EXPECT_EQ(recall.at(2), 1.0) << "complete by construction";
  EXPECT_LT(force[2], 1e-14) << "truth adds up the same LMDs, to rounding";
  EXPECT_LT(recall[1], recall[0]) << "a search every 40 frames leaves older sets than one every 5";
  EXPECT_GT(force[1], force[0]);
  for (const double rendered : file.doubles("/points/rendered_force_median_n")) EXPECT_GT(rendered, 0.0);
  for (const double share : file.doubles("/points/processor_share")) EXPECT_GT(share, 0.0);
  EXPECT_THAT(file.doubles("/points/truth_checked_frames"), ElementsAre(4, 4, 4));
  EXPECT_THAT(file.doubles("/points/truth_wrong_frames"), ElementsAre(0, 0, 0));
  EXPECT_THAT(file.shape("/samples/0/local_update_time"), ElementsAre(2u, 400u));
  EXPECT_EQ(nlohmann::json::parse(file.strings("/points/axes").at(1))["/driver/search_every_frames"], 40);
  const ResultReader reader(scratch_ / "out.h5");
  for (const PointNumber& number : point_numbers()) {
    const std::string path = "/points/" + std::string(number.name);
    EXPECT_EQ(file.shape(path), std::vector<std::size_t>{3}) << path;
    EXPECT_FALSE(file.text_attribute(path, "units").empty()) << path;
    EXPECT_EQ(reader.integer_attribute(path, "made_of_times") == 1, number.made_of_times) << path;
  }
  EXPECT_TRUE(on_front(sweep, result, 2)) << "nothing has less error than none";

  const nlohmann::json rows = nlohmann::json::parse(sweep_json(sweep, result));
  EXPECT_EQ(rows.at(2)["recall"], 1.0);
  EXPECT_TRUE(rows[2]["first_reduction_median_s"].is_null()) << "certified has no reduction";
  EXPECT_THAT(sweep_text(sweep, result), HasSubstr("improved search_every_frames=5"));
}

TEST_F(RunSweep, PointsOfAnotherProblemDoNotBeatEachOther) {
  const Sweep sweep = loaded(R"(, "axes": [{"/force/maximum_force_n": [1, 2]}])");
  const SweepResult result = run(sweep);
  ASSERT_EQ(result.points.size(), 4u);
  EXPECT_TRUE(on_front(sweep, result, 2));
  EXPECT_TRUE(on_front(sweep, result, 3))
      << "neither has an error, but one costs more: it is another problem";
  EXPECT_NE(sweep.points[2].problem, sweep.points[3].problem);
  EXPECT_THAT(sweep_text(sweep, result), HasSubstr(sweep.points[3].problem + ": * on the front"));
  EXPECT_EQ(nlohmann::json::parse(sweep_json(sweep, result)).at(3)["problem"], sweep.points[3].problem);
  EXPECT_EQ(OpenResult(scratch_ / "out.h5").strings("/points/problem").at(3), sweep.points[3].problem);
}

TEST_F(RunSweep, GoesOnWhereItStopped) {
  const Sweep sweep = loaded();
  const auto stop_after = [](int calls) {
    return [calls](const std::string& phase, std::int64_t done, std::int64_t) {
      return phase != "points" || done < calls;
    };
  };
  EXPECT_THROW(run_sweep_to_file(sweep, scratch_ / "out.h5", {}, stop_after(4)), Interrupted);
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out.h5")) << "an unfinished sweep has no result";
  const SweepResult rest = run(sweep);
  EXPECT_EQ(rest.resumed_runs, 4);
  const SweepResult again = run(sweep);
  EXPECT_EQ(again.resumed_runs, 6) << "all of it";
  ASSERT_EQ(again.points.size(), rest.points.size());
  for (std::size_t i = 0; i < again.points.size(); ++i) {
    EXPECT_EQ(again.points[i].numbers, rest.points[i].numbers) << "times, too: they are the same samples";
    EXPECT_EQ(again.points[i].result_hash, rest.points[i].result_hash);
  }

  EXPECT_EQ(run(loaded("", 390)).resumed_runs, 0) << "another path length is another point";
}

TEST_F(RunSweep, KeepsAFailedPointAsAFailureAndGoesOn) {
  const Sweep sweep = loaded(R"(, "axes": [{"/moving/mesh": ["blob", "./missing.off"]}])");
  const SweepResult result = run(sweep);
  ASSERT_EQ(result.points.size(), 4u);
  EXPECT_TRUE(result.points[2].failure.empty());
  EXPECT_THAT(result.points[3].failure, HasSubstr("missing.off"));
  EXPECT_TRUE(std::isnan(result.points[3].number("recall")));
  EXPECT_FALSE(on_front(sweep, result, 3));
  EXPECT_THAT(sweep_text(sweep, result), HasSubstr("failed  certified"));
  const OpenResult file(scratch_ / "out.h5");
  EXPECT_THAT(file.strings("/points/failure").at(3), HasSubstr("missing.off"));
  EXPECT_FALSE(file.has("/samples/3"));
}

TEST_F(RunSweep, RepetitionsThatDifferAreAFailureUntilTheyAgree) {
  const Sweep sweep = loaded();
  const auto stop_behind_the_first = [](const std::string& phase, std::int64_t done, std::int64_t) {
    return phase != "points" || done < 3;
  };
  EXPECT_THROW(run_sweep_to_file(sweep, scratch_ / "out.h5", {}, stop_behind_the_first), Interrupted);
  std::string journal = testing::read_text(scratch_ / "out.h5.points.jsonl");
  const std::string hash = "\"result_hash\":\"";
  for (auto at = journal.find(hash); at != std::string::npos; at = journal.find(hash, at + 1))
    journal.insert(at + hash.size(), "0");
  scratch_.write("out.h5.points.jsonl", journal);
  const SweepResult differ = run(sweep);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_THAT(differ.points.at(i).failure, HasSubstr("two repetitions differ"));
    EXPECT_TRUE(differ.points[i].numbers.empty());
    EXPECT_FALSE(on_front(sweep, differ, i));
  }
  EXPECT_FALSE(OpenResult(scratch_ / "out.h5").has("/samples"));
  const SweepResult again = run(sweep);
  EXPECT_EQ(again.resumed_runs, 0) << "nobody knows which repetition was right";
  for (const PointResult& point : again.points) EXPECT_EQ(point.failure, "");
  EXPECT_EQ(run(sweep).resumed_runs, 6);
}

TEST_F(RunSweep, APointWithoutAFrameThatCountsIsAFailure) {
  for (const PointResult& point : run(loaded("", 400, R"(, "from_frame": 399)")).points)
    EXPECT_THAT(point.failure,
                AllOf(HasSubstr("/from_frame"), HasSubstr("of 400 the first 399 and the last")));
}

TEST_F(RunSweep, JudgesAStandInByTheMeshThatItStandsFor) {
  const SweepResult result =
      run(loaded(R"(, "set": {"/moving/mesh": "sphere"}, "truth": {"/moving/mesh": "blob"})"));
  EXPECT_TRUE(std::isnan(result.points.at(2).number("recall"))) << "features of two meshes do not correspond";
  EXPECT_GT(result.points[2].number("force_error_rms_n"), 0.0) << "exact on the wrong mesh";
}

/// Its features have numbers that the truth's mesh does not have.
TEST_F(RunSweep, TheMeshOfTruthMayBeTheCoarserOne) {
  const SweepResult result =
      run(loaded(R"(, "truth": {"/moving/mesh": "small-blob", "/fixed/0/mesh": "box"})"));
  EXPECT_EQ(result.points.at(2).failure, "");
  EXPECT_TRUE(std::isnan(result.points[2].number("recall")));
}

TEST_F(RunSweep, ReplacesNothingButItsOwn) {
  const Sweep sweep = loaded();
  scratch_.write("out.h5.points.jsonl", "somebody's notes\n");
  EXPECT_THROW(run(sweep), UsageError);
  EXPECT_EQ(testing::read_text(scratch_ / "out.h5.points.jsonl"), "somebody's notes\n");
}

TEST_F(RunSweep, PointsAreKnownWhereverTheirFilesAre) {
  namespace fs = std::filesystem;
  const fs::path source = LMDBENCH_SOURCE_DIR;
  fs::create_directories(scratch_ / "a/experiments");
  fs::copy_file(source / "experiments/shapes.json", scratch_ / "a/experiments/shapes.json");
  fs::copy(source / "paths", scratch_ / "a/paths");
  fs::create_directory_symlink(source / "meshes", scratch_ / "a/meshes");
  const auto keys = [&](const std::string& folder) {
    const std::string text = R"({"name": "s", "experiments": [")" + folder + R"(/experiments/shapes.json"],
        "series": [{"method": {"name": "certified", "force_law": "linear"}}]})";
    InputHashes hashes;
    return point_keys(load_sweep(scratch_.write("sweep.json", text)), hashes);
  };
  const std::vector<std::string> known = keys("a");
  fs::rename(scratch_ / "a", scratch_ / "b");
  EXPECT_EQ(keys("b"), known);
  scratch_.write("b/paths/shapes.tum", testing::read_text(scratch_ / "b/paths/shapes.tum") + "# changed\n");
  EXPECT_NE(keys("b"), known);
}

TEST(PointNumbers, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const PointNumber& number : point_numbers())
    EXPECT_TRUE(names.insert(number.name).second) << number.name;
}

TEST(PointNumbers, SayWhichAreMadeOfTimes) {
  const std::set<std::string_view> times{"processor_share", "search_share", "frames_late"};
  for (const PointNumber& number : point_numbers()) {
    const bool is_time = number.units == "s" && number.name != "seconds_in_contact";
    EXPECT_EQ(number.made_of_times, is_time || times.contains(number.name)) << number.name;
  }
}

}  // namespace
}  // namespace lmdbench
