// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/result_file/result_writer.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <result_file/result_reading.h>
#include <support/files.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace lmdbench {
namespace {

using ::testing::ElementsAre;
using testing::OpenResult;
using testing::ScratchDirectory;

constexpr double NOT_SET = std::numeric_limits<double>::quiet_NaN();

TEST(ResultWriter, KeepsValuesShapesAndMeaning) {
  const ScratchDirectory directory;
  const std::vector<double> force{1.0, -2.5, 3.25, NOT_SET, 1e-300, 0.1};
  const std::vector<std::int64_t> counts{0, -1, std::numeric_limits<std::int64_t>::max()};
  const std::vector<std::uint8_t> flags{0, 1, 255};
  ResultWriter writer(directory / "a.h5");
  writer.write({"/methods/improved/force", "N", "force on the moving mesh"}, force, {2, 3});
  writer.write({"/methods/improved/lmd_count", "1", "LMDs in use"}, counts, {3});
  writer.write({"/methods/improved/force_clipped", "1", "1 where the device limit cut the force"}, flags,
               {3});
  writer.write({"/provenance/argv", "1", "command line"}, {"lmdbench", "", "run \xC3\xA9"});
  writer.commit();

  const OpenResult result(directory / "a.h5");
  EXPECT_THAT(result.shape("/methods/improved/force"), ElementsAre(2, 3));
  const std::vector<double> read = result.doubles("/methods/improved/force");
  ASSERT_EQ(read.size(), force.size());
  for (std::size_t i = 0; i < force.size(); ++i) {
    if (i == 3) {
      EXPECT_TRUE(std::isnan(read[i]));
    } else {
      EXPECT_EQ(read[i], force[i]) << i;
    }
  }
  EXPECT_EQ(result.integers("/methods/improved/lmd_count"), counts);
  EXPECT_EQ(result.bytes("/methods/improved/force_clipped"), flags);
  EXPECT_THAT(result.strings("/provenance/argv"), ElementsAre("lmdbench", "", "run \xC3\xA9"));
  EXPECT_EQ(result.text_attribute("/methods/improved/force", "units"), "N");
  EXPECT_EQ(result.text_attribute("/methods/improved/force", "long_name"), "force on the moving mesh");
  EXPECT_EQ(result.text_attribute("/provenance/argv", "units"), "1");
}

TEST(ResultWriter, WritesEmptyAndScalarDatasets) {
  const ScratchDirectory directory;
  ResultWriter writer(directory / "a.h5");
  writer.write({"/truth/force", "N", "no frame was sampled"}, std::vector<double>{}, {0, 3});
  writer.write({"/list", "1", "empty list"}, std::vector<std::string>{});
  writer.write({"/one", "s", "a single number"}, std::vector<double>{2.0}, {});
  writer.commit();
  const OpenResult result(directory / "a.h5");
  EXPECT_THAT(result.shape("/truth/force"), ElementsAre(0, 3));
  EXPECT_EQ(result.text_attribute("/truth/force", "units"), "N");
  EXPECT_THAT(result.shape("/list"), ElementsAre(0));
  EXPECT_TRUE(result.shape("/one").empty());
  EXPECT_THAT(result.doubles("/one"), ElementsAre(2.0));
}

TEST(ResultWriter, CompressesLargeDatasetsAlone) {
  const ScratchDirectory directory;
  std::vector<double> samples(5 * 40'000);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = 1e-6 * static_cast<double>(i % 977);
  ResultWriter writer(directory / "a.h5");
  writer.write({"/local_update_time", "s", "time of each update"}, samples, {5, 40'000});
  writer.write({"/small", "s", "few values"}, std::span(samples).first(100), {100});
  writer.commit();
  const OpenResult result(directory / "a.h5");
  EXPECT_EQ(result.layout("/local_update_time"), H5D_CHUNKED);
  EXPECT_EQ(result.layout("/small"), H5D_CONTIGUOUS);
  EXPECT_EQ(result.doubles("/local_update_time"), samples);
  EXPECT_LT(std::filesystem::file_size(directory / "a.h5"), samples.size() * sizeof(double) / 4);
}

TEST(ResultWriter, GivesAttributesToGroupsDatasetsAndTheRoot) {
  const ScratchDirectory directory;
  ResultWriter writer(directory / "a.h5");
  writer.attribute("/", "format", "lmdbench-result");
  writer.attribute("/methods/original", "repetitions", std::int64_t{7});
  writer.write({"/path/time", "s", "time of each frame"}, std::vector<double>{0.0, 0.001}, {2});
  writer.attribute("/path/time", "rate", 1000.0);
  writer.attribute("/path/time", "rate", 500.0);
  writer.attribute("/", "plan", std::string(200'000, 'x'));
  writer.commit();
  const OpenResult result(directory / "a.h5");
  EXPECT_EQ(result.text_attribute("/", "format"), "lmdbench-result");
  EXPECT_EQ(result.integer_attribute("/methods/original", "repetitions"), 7);
  EXPECT_EQ(result.real_attribute("/path/time", "rate"), 500.0) << "the later value counts";
  EXPECT_EQ(result.text_attribute("/", "plan").size(), 200'000u);
}

TEST(ResultWriter, SameContentGivesTheSameBytes) {
  const ScratchDirectory directory;
  std::vector<double> values(50'000);
  std::iota(values.begin(), values.end(), 0.5);
  for (const char* name : {"a.h5", "b.h5"}) {
    ResultWriter writer(directory / name);
    writer.attribute("/methods", "order", "original, improved");
    writer.write({"/methods/original/force", "N", "force"}, values, {25'000, 2});
    writer.write({"/provenance/argv", "1", "command line"}, {"lmdbench", "run"});
    writer.commit();
  }
  EXPECT_EQ(testing::read_text(directory / "a.h5"), testing::read_text(directory / "b.h5"));
}

TEST(ResultWriter, RefusesMistakesOfItsCaller) {
  const ScratchDirectory directory;
  const std::vector<double> values{1.0, 2.0, 3.0};
  ResultWriter writer(directory / "a.h5");
  EXPECT_THROW(writer.write({"/a", "m", "wrong shape"}, values, {2, 2}), std::invalid_argument);
  EXPECT_THROW(writer.write({"/a", "", "no units"}, values, {3}), std::invalid_argument);
  EXPECT_THROW(writer.write({"/a", "m", ""}, values, {3}), std::invalid_argument);
  EXPECT_THROW(writer.write({"a", "m", "relative path"}, values, {3}), std::invalid_argument);
  EXPECT_THROW(writer.write({"/a/", "m", "no name"}, values, {3}), std::invalid_argument);
  writer.write({"/a", "m", "right"}, values, {3});
  EXPECT_THROW(writer.write({"/a", "m", "twice"}, values, {3}), std::invalid_argument);
  writer.commit();
  EXPECT_THROW(writer.write({"/b", "m", "too late"}, values, {3}), std::logic_error);
  EXPECT_THROW(writer.commit(), std::logic_error);
}

TEST(ResultWriter, HasTheFinalNameOnlyAfterCommit) {
  const ScratchDirectory directory;
  const std::filesystem::path file = directory / "a.h5";
  {
    ResultWriter writer(file);
    writer.write({"/a", "m", "first"}, std::vector<double>{1.0}, {1});
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_TRUE(std::filesystem::exists(file.string() + ".part"));
    writer.commit();
    EXPECT_TRUE(std::filesystem::exists(file));
    EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
  }
  const std::string first = testing::read_text(file);
  {
    ResultWriter interrupted(file);
    interrupted.write({"/a", "m", "second"}, std::vector<double>{2.0}, {1});
  }
  EXPECT_EQ(testing::read_text(file), first) << "an interrupted run leaves the earlier result whole";
  EXPECT_TRUE(std::filesystem::exists(file.string() + ".part"));
  ResultWriter writer(file);
  writer.write({"/a", "m", "third"}, std::vector<double>{3.0}, {1});
  writer.commit();
  EXPECT_THAT(OpenResult(file).doubles("/a"), ElementsAre(3.0));
}

}  // namespace
}  // namespace lmdbench
