// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/result_file/provenance.h>
#include <lmdbench/result_file/result_reader.h>
#include <lmdbench/result_file/result_writer.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <support/files.h>
#include <support/message_of.h>
#include <support/scratch_directory.h>
#include <support/source_directory.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double MISSING = std::numeric_limits<double>::quiet_NaN();

/// A small result with one dataset of each kind, one of them compressed.
std::filesystem::path small_result(const std::filesystem::path& file,
                                   std::int64_t version = RESULT_FORMAT_VERSION,
                                   const std::string& format = RESULT_FORMAT) {
  ResultWriter writer(file);
  writer.attribute("/", "format", format);
  writer.attribute("/", "format_version", version);
  writer.attribute("/scene", "cutoff_m", 0.25);
  writer.write({"/methods/b/force", "N", "force"}, std::vector<double>{1.0, MISSING, -3.0, 0.1, 5.0, 6.0},
               {2, 3});
  writer.write({"/methods/a/lmd_count", "1", "count"}, std::vector<std::int64_t>{1, -2}, {2});
  writer.write({"/methods/a/force_clipped", "1", "flag"}, std::vector<std::uint8_t>{0, 1}, {2});
  writer.write({"/methods/a/empty", "1", "nothing"}, std::vector<double>{}, {3, 0});
  writer.write({"/provenance/argv", "1", "texts"}, {"lmdbench", "", "run"});
  std::vector<double> many(20000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<double>(i) / 7.0;
  writer.write({"/methods/a/many", "s", "compressed"}, many, {20000});
  writer.commit();
  return file;
}

/// The message of the InputError that `work` must throw.
std::string input_error(const std::function<void()>& work) {
  return testing::message_of<InputError>(work);
}

TEST(ResultReader, ReadsWhatTheWriterWrote) {
  const testing::ScratchDirectory scratch;
  const ResultReader reader(small_result(scratch / "r.h5"));
  EXPECT_EQ(reader.file(), scratch / "r.h5");
  const std::vector<double> force = reader.reals("/methods/b/force");
  ASSERT_EQ(force.size(), 6U);
  EXPECT_TRUE(std::isnan(force[1]));
  EXPECT_EQ(force[3], 0.1);
  EXPECT_THAT(reader.shape("/methods/b/force"), ElementsAre(2, 3));
  EXPECT_THAT(reader.integers("/methods/a/lmd_count"), ElementsAre(1, -2));
  EXPECT_THAT(reader.integers("/methods/a/force_clipped"), ElementsAre(0, 1));
  EXPECT_THAT(reader.reals("/methods/a/lmd_count"), ElementsAre(1.0, -2.0));
  EXPECT_THAT(reader.reals("/methods/a/empty"), IsEmpty());
  EXPECT_THAT(reader.texts("/provenance/argv"), ElementsAre("lmdbench", "", "run"));
  EXPECT_EQ(reader.reals("/methods/a/many")[19999], 19999.0 / 7.0);
  EXPECT_EQ(reader.kind("/methods/b/force"), ElementKind::REAL);
  EXPECT_EQ(reader.kind("/methods/a/force_clipped"), ElementKind::INTEGER);
  EXPECT_EQ(reader.kind("/provenance/argv"), ElementKind::TEXT);
}

TEST(ResultReader, ListsGroupsDatasetsAndAttributesInOrder) {
  const testing::ScratchDirectory scratch;
  const ResultReader reader(small_result(scratch / "r.h5"));
  EXPECT_THAT(reader.groups("/methods"), ElementsAre("a", "b"));
  EXPECT_THAT(reader.datasets("/methods"), IsEmpty());
  EXPECT_THAT(reader.datasets("/methods/a"), ElementsAre("empty", "force_clipped", "lmd_count", "many"));
  EXPECT_THAT(reader.groups("/absent/group"), IsEmpty());
  EXPECT_THAT(reader.attributes("/"), ElementsAre("content_sha256", "format", "format_version"));
  EXPECT_TRUE(reader.has("/methods/b/force"));
  EXPECT_FALSE(reader.has("/methods/c/force"));
  EXPECT_EQ(reader.real_attribute("/scene", "cutoff_m"), 0.25);
  EXPECT_EQ(reader.integer_attribute("/", "format_version"), RESULT_FORMAT_VERSION);
  EXPECT_EQ(reader.text_attribute("/methods/b/force", "units"), "N");
  EXPECT_EQ(reader.attribute_kind("/scene", "cutoff_m"), ElementKind::REAL);
  EXPECT_EQ(reader.attribute_kind("/", "format"), ElementKind::TEXT);
  EXPECT_EQ(reader.attribute_kind("/", "absent"), std::nullopt);
  EXPECT_EQ(reader.text_attribute("/scene", "absent"), std::nullopt);
  EXPECT_EQ(reader.text_attribute("/absent", "units"), std::nullopt);
}

TEST(ResultReader, NamesFileDatasetAndRemedy) {
  const testing::ScratchDirectory scratch;
  const std::string name = (scratch / "r.h5").string();
  const ResultReader reader(small_result(name));
  const auto names = [&](const std::string& dataset) {
    return AllOf(HasSubstr(name), HasSubstr(dataset), HasSubstr("remedy: "));
  };
  EXPECT_THAT(input_error([&] { reader.reals("/methods/c/force"); }),
              AllOf(names("/methods/c/force"), HasSubstr("missing")));
  EXPECT_THAT(input_error([&] { reader.integers("/methods/b/force"); }), names("/methods/b/force"));
  EXPECT_THAT(input_error([&] { reader.reals("/provenance/argv"); }), names("/provenance/argv"));
  EXPECT_THAT(input_error([&] { reader.texts("/methods/b/force"); }), names("/methods/b/force"));
  EXPECT_THAT(input_error([&] { reader.reals("/methods/b"); }), names("/methods/b"));
  EXPECT_THAT(input_error([&] { reader.real_attribute("/", "format"); }), names("format"));
}

TEST(ResultReader, RefusesWhatIsNoResult) {
  const testing::ScratchDirectory scratch;
  EXPECT_THAT(input_error([&] { ResultReader(scratch / "absent.h5"); }), HasSubstr("no such result file"));
  EXPECT_THAT(input_error([&] { ResultReader(scratch / "."); }), HasSubstr("directory"));
  std::ofstream(scratch / "text.h5") << "not HDF5";
  EXPECT_THAT(input_error([&] { ResultReader(scratch / "text.h5"); }), HasSubstr("cannot be opened as HDF5"));
  std::ofstream(scratch / "empty.h5").flush();
  EXPECT_THAT(input_error([&] { ResultReader(scratch / "empty.h5"); }),
              HasSubstr("cannot be opened as HDF5"));
  EXPECT_THAT(
      input_error([&] { ResultReader(small_result(scratch / "future.h5", RESULT_FORMAT_VERSION + 1)); }),
      AllOf(HasSubstr("format_version"), HasSubstr("remedy: ")));
  EXPECT_THAT(input_error([&] { ResultReader(small_result(scratch / "other.h5", 1, "other-format")); }),
              AllOf(HasSubstr("other-format"), HasSubstr("remedy: ")));
}

TEST(ResultReader, RefusesLinksAndValuesOfOtherFiles) {
  const std::string corpus = LMDBENCH_SOURCE_DIR "/tests/fuzz/corpus/result/";
  const ResultReader links(corpus + "links");
  EXPECT_THAT(input_error([&] { links.groups("/"); }),
              AllOf(HasSubstr("/outside: is a link"), HasSubstr("remedy: ")));
  EXPECT_THAT(input_error([&] { links.reals("/soft/a/force"); }), HasSubstr("/soft: is a link"));
  EXPECT_THAT(links.groups("/methods"), ElementsAre("a"));
  const ResultReader elsewhere(corpus + "values_elsewhere");
  EXPECT_THAT(input_error([&] { elsewhere.reals("/ext"); }),
              HasSubstr("/ext: has its values in another file"));
}

/// Other programs write texts of fixed length.
TEST(ResultReader, TextsOfAFixedLengthAreNoDamage) {
  const testing::ScratchDirectory scratch;
  const std::filesystem::path file = small_result(scratch / "a.h5");
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), space = H5Screate(H5S_SCALAR);
  ASSERT_GE(H5Adelete(opened, "content_sha256"), 0) << "a change on purpose";
  const hid_t type = H5Tcopy(H5T_C_S1);
  ASSERT_GE(H5Tset_size(type, 5), 0);
  const hid_t note = H5Acreate2(opened, "note", type, space, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Awrite(note, type, "hello"), 0);
  H5Aclose(note);
  H5Tclose(type);
  H5Sclose(space);
  H5Fclose(opened);
  EXPECT_THAT(ResultReader(file).attributes("/"), ::testing::Contains("note"));
}

TEST(ResultReader, NamesTheDamageOfAFileWhenItIsOpened) {
  EXPECT_THAT(input_error([] {
                ResultReader(LMDBENCH_SOURCE_DIR "/tests/fuzz/corpus/result/claims_more_than_it_holds");
              }),
              AllOf(HasSubstr("/big: is damaged: its shape asks for more values"), HasSubstr("remedy: ")));
}

TEST(ResultReader, DamagedFilesAreInputErrors) {
  const testing::ScratchDirectory scratch;
  const std::string bytes = testing::read_text(small_result(scratch / "whole.h5"));
  const auto read_all = [](const std::filesystem::path& file) {
    const ResultReader reader(file);
    for (const std::string& group : reader.groups("/methods"))
      for (const std::string& dataset : reader.datasets("/methods/" + group))
        reader.reals("/methods/" + group + "/" + dataset);
    reader.texts("/provenance/argv");
  };
  std::mt19937 random(20);
  int cut = 0;
  for (int i = 0; i < 200; ++i) {
    std::string damaged = bytes;
    if (i % 2 == 0) {
      damaged.resize(random() % bytes.size());
    } else {
      for (int k = 0; k < 8; ++k) damaged[random() % bytes.size()] = static_cast<char>(random());
    }
    std::ofstream(scratch / "damaged.h5", std::ios::binary) << damaged;
    try {
      read_all(scratch / "damaged.h5");
    } catch (const InputError&) {
      cut += i % 2 == 0 ? 1 : 0;  // any other exception fails the test
    }
  }
  EXPECT_EQ(cut, 100) << "every cut file must be refused";
}

}  // namespace
}  // namespace lmdbench
