// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_descriptor.h>
#include <lmdbench/sweep/sweep_parts.h>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <result_file/result_reading.h>
#include <support/message_of.h>
#include <sweep/small_sweep.h>

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::OpenResult;
using testing::ScratchDirectory;

class SweepParts : public ::testing::Test {
 protected:
  Sweep sweep(const std::string& last_mesh = "sphere") {
    const std::string axes = R"(, "axes": [{"/moving/mesh": ["blob", ")" + last_mesh + "\"]}]";
    return load_sweep(scratch_.write("sweep.json", testing::small_sweep(120, 2, axes)));
  }
  SweepResult collect(const Sweep& sweep) { return collect_sweep_to_file(sweep, out_, {"lmdbench"}); }
  std::vector<bool> done(const Sweep& sweep) {
    std::vector<bool> result;
    for (const auto& point : nlohmann::json::parse(point_list_json(sweep, out_)))
      result.push_back(point["done"]);
    return result;
  }

  ScratchDirectory scratch_;
  std::filesystem::path out_ = scratch_ / "out.h5";
};

TEST_F(SweepParts, AreTheWholeSweepButForTimes) {
  const Sweep all = sweep();
  EXPECT_EQ(measure_part(all, {3, 1}, out_).resumed_runs, 0);
  EXPECT_THAT(done(all), ElementsAre(false, true, false, true));
  measure_part(all, {0}, out_);
  measure_part(all, {2}, out_);
  EXPECT_FALSE(std::filesystem::exists(out_)) << "parts write no result";
  const SweepResult collected = collect(all);
  const SweepResult alone = run_sweep_to_file(all, scratch_ / "alone.h5", {"lmdbench"});
  ASSERT_EQ(collected.points.size(), 4u);
  for (std::size_t i = 0; i < collected.points.size(); ++i) {
    EXPECT_EQ(collected.points[i].result_hash, alone.points[i].result_hash) << i;
    EXPECT_EQ(collected.points[i].errors.numbers, alone.points[i].errors.numbers) << i;
    EXPECT_EQ(collected.points[i].errors.counters, alone.points[i].errors.counters) << i;
    EXPECT_EQ(collected.points[i].begun, 2);
  }
  EXPECT_THAT(done_again(all, out_), ElementsAre());
  const OpenResult file(out_);
  EXPECT_THAT(file.doubles("/points/begun"), ElementsAre(2, 2, 2, 2));
  const auto where = nlohmann::json::parse(file.strings("/points/where").at(3));
  ASSERT_EQ(where.size(), 2u) << "one a repetition";
  EXPECT_FALSE(where[0]["node"].get<std::string>().empty());
  EXPECT_TRUE(where[0].contains("neighbours"));
  const OpenResult own(scratch_ / "alone.h5");
  EXPECT_FALSE(nlohmann::json::parse(own.strings("/points/where").at(0))[0].contains("node"))
      << "nobody's own machine is named";
}

TEST_F(SweepParts, MeasureNothingThatAnotherJournalKnows) {
  const Sweep all = sweep();
  measure_part(all, {0}, out_);
  EXPECT_EQ(measure_part(all, {0, 1}, out_).resumed_runs, 2);
  EXPECT_EQ(run_sweep_to_file(all, out_, {"lmdbench"}).resumed_runs, 4) << "nor does the sweep as a whole";
  EXPECT_EQ(measure_part(all, {2, 3}, out_).resumed_runs, 4) << "nor a part what the whole measured";
}

TEST_F(SweepParts, CollectingNamesThePointsThatLack) {
  const Sweep all = sweep();
  measure_part(all, {2}, out_);
  EXPECT_THAT(testing::message_of<InputError>([&] { collect(all); }),
              AllOf(HasSubstr("3 of 4 points are not measured: 0-1,3"), HasSubstr("--points")))
      << "nobody has measured the others";
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(SweepParts, AreDoneWithTheLastRepetition) {
  const Sweep all = sweep();
  measure_part(all, {0, 1, 2}, out_);
  const auto stop_after_one = [](const std::string& phase, std::int64_t at, std::int64_t) {
    return phase != "points" || at < 1;
  };
  EXPECT_THROW(measure_part(all, {3}, out_, stop_after_one), Interrupted);
  EXPECT_THAT(done(all), ElementsAre(true, true, true, false));
  EXPECT_THROW(collect(all), InputError);
  EXPECT_EQ(measure_part(all, {3}, out_).resumed_runs, 1);
  EXPECT_EQ(collect(all).points[3].begun, 2) << "each repetition once";
}

TEST_F(SweepParts, NamesWhatWasBegunAgain) {
  const Sweep all = sweep();
  const auto stop_at_truth = [](const std::string& phase, std::int64_t, std::int64_t) {
    return phase != "truth";
  };
  EXPECT_THROW(measure_part(all, {1}, out_, stop_at_truth), Interrupted) << "after it had begun";
  EXPECT_THAT(done(all), ElementsAre(false, false, false, false));
  measure_part(all, {1}, out_);
  measure_part(all, {0, 2, 3}, out_);
  const std::vector<std::string> again = done_again(all, out_);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_THAT(again[0], HasSubstr("point 1 (shapes, improved, search_every_frames=40"));
  EXPECT_THAT(again[0], HasSubstr("repetition 0, began 2 times: "));
  const SweepResult result = collect(all);
  EXPECT_EQ(result.points[0].begun, 2);
  EXPECT_EQ(result.points[1].begun, 3);
}

TEST_F(SweepParts, AWholeSweepCountsItsOwnBeginningsOnce) {
  const Sweep all = sweep();
  const auto stop_at_truth = [](const std::string& phase, std::int64_t, std::int64_t) {
    return phase != "truth";
  };
  EXPECT_THROW(run_sweep_to_file(all, out_, {"lmdbench"}, stop_at_truth), Interrupted);
  std::int64_t begun = 0;
  for (const auto& point : run_sweep_to_file(all, out_, {"lmdbench"}).points) begun += point.begun;
  EXPECT_EQ(begun, 4 * 2 + 1) << "two repetitions of four points, one of which was interrupted";
  EXPECT_EQ(done_again(all, out_).size(), 1u);
}

TEST_F(SweepParts, OfOneNameWaitForEachOther) {
  const Sweep all = sweep();
  measure_part(all, {1}, out_);
  const std::filesystem::path part = std::filesystem::directory_iterator(parts_folder(out_))->path();
  FileDescriptor other(::open(part.c_str(), O_RDWR | O_CLOEXEC));
  ASSERT_TRUE(lock_whole_file(other.get()));
  int waited = 0;
  const auto release_in_a_while = [&](const std::string& phase, std::int64_t, std::int64_t) {
    if (phase.starts_with("another process") && ++waited == 3) other.close();
    return true;
  };
  EXPECT_EQ(measure_part(all, {1}, out_, release_in_a_while).resumed_runs, 2)
      << "what the other one did counts";
  EXPECT_EQ(waited, 3);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(parts_folder(out_)), {}), 1);
}

TEST_F(SweepParts, KeepAFailureUntilSomebodySucceeds) {
  const Sweep broken = sweep("./missing.off");
  const SweepWork work = measure_part(broken, {2, 3}, out_);
  ASSERT_EQ(work.failures.size(), 1u);
  EXPECT_THAT(work.failures.at(3), HasSubstr("missing.off"));
  EXPECT_THAT(done(broken), ElementsAre(false, false, true, false)) << "the next call tries it again";
  measure_part(broken, {0, 1}, out_);
  EXPECT_THAT(collect(broken).points[3].failure, HasSubstr("missing.off"))
      << "as the sweep in one process has it";
}

TEST_F(SweepParts, NumberPointsByScene) {
  const auto points = nlohmann::json::parse(point_list_json(sweep(), out_));
  std::vector<int> groups, numbers;
  for (const auto& point : points) {
    groups.push_back(point["group"]);
    numbers.push_back(point["number"]);
  }
  EXPECT_THAT(groups, ElementsAre(0, 0, 0, 1)) << "another mesh is another scene";
  EXPECT_THAT(numbers, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(points[1]["axes"]["/driver/search_every_frames"], 40);
  EXPECT_THAT(point_list_text(sweep(), out_), HasSubstr("     3       shapes, certified"));
}

TEST(PointNumbers, AreReadAndWritten) {
  EXPECT_THAT(parse_point_numbers("0-3,7", 8, "--points"), ElementsAre(0, 1, 2, 3, 7));
  EXPECT_THAT(parse_point_numbers("7,2", 8, "--points"), ElementsAre(7, 2));
  EXPECT_EQ(point_numbers_text({0, 1, 2, 3, 7, 9, 10}), "0-3,7,9-10");
  EXPECT_EQ(point_numbers_text({}), "");
  for (const auto& [text, problem] :
       std::vector<std::pair<std::string, std::string>>{{"", "no list"},
                                                        {"1,", "no list"},
                                                        {"x", "no list"},
                                                        {"1;2", "no list"},
                                                        {"-1", "no list"},
                                                        {"3-1", "runs backwards"},
                                                        {"1,0-2", "names point 1 twice"},
                                                        {"8", "there is no point 8: the sweep has 8"},
                                                        {"0-99999999999999999999", "no list"}}) {
    EXPECT_THAT(testing::message_of<UsageError>([&] { parse_point_numbers(text, 8, "--points"); }),
                AllOf(HasSubstr(problem), HasSubstr("--points")))
        << text;
  }
}

}  // namespace
}  // namespace lmdbench
