// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/result_file/hdf5_check.h>
#include <lmdbench/result_file/provenance.h>
#include <lmdbench/result_file/result_reader.h>
#include <lmdbench/result_file/result_writer.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/files.h>
#include <support/message_of.h>
#include <support/scratch_directory.h>

#include <cstdint>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;
using testing::read_text;
using testing::ScratchDirectory;

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// A small contiguous dataset, a large chunked one, and a text.
std::filesystem::path write_result(const std::filesystem::path& file) {
  ResultWriter writer(file);
  writer.attribute("/", "format", RESULT_FORMAT);
  writer.attribute("/", "format_version", std::int64_t{RESULT_FORMAT_VERSION});
  writer.write({"/small", "m", "a few numbers"}, std::vector<double>{1.0, 2.0, 3.0}, {3});
  std::vector<double> many(40'000);
  std::mt19937_64 random(5);
  for (double& value : many) value = static_cast<double>(random()) * 0x1p-64;
  writer.write({"/large", "m", "many numbers"}, many, {many.size()});
  writer.write({"/text", "1", "a text"}, {std::string(100, 'a') + "some words"});
  writer.commit();
  return file;
}

/// The error message of reading a file; empty if it can be read.
std::string refusal(const std::filesystem::path& file) {
  return testing::complaint_of<InputError>([&] { const ResultReader reader(file); });
}

TEST(ContentHash, IsTheShaOfTheBytesWithoutItself) {
  const ScratchDirectory scratch;
  const std::filesystem::path file = write_result(scratch / "a.h5");
  const ResultReader reader(file);
  const std::string hash = reader.text_attribute("/", CONTENT_HASH).value_or("");
  ASSERT_EQ(hash.size(), 64U);
  std::string bytes = read_text(file);
  bytes.replace(bytes.find(hash), hash.size(), hash.size(), '0');
  EXPECT_EQ(sha256_of_text(bytes), hash);
  EXPECT_EQ(read_text(file), read_text(write_result(scratch / "b.h5"))) << "the same bytes in every run";
}

TEST(ContentHash, EveryFlippedByteIsSeen) {
  const ScratchDirectory scratch;
  const std::string whole = read_text(write_result(scratch / "whole.h5"));
  ASSERT_EQ(refusal(scratch / "whole.h5"), "");
  // At every place of the structure at the file's start and end, and some within the numbers.
  std::vector<std::size_t> places{whole.find("some words")};
  for (std::size_t at = 8; at < whole.size(); at += whole.size() / 60) places.push_back(at);
  for (const std::size_t place : places) {
    std::string bytes = whole;
    bytes[place] = static_cast<char>(bytes[place] ^ 0x10);
    write_bytes(scratch / "flipped.h5", bytes);
    EXPECT_THAT(refusal(scratch / "flipped.h5"), HasSubstr("remedy: ")) << "byte " << place;
  }
}

TEST(ContentHash, ATextThatWasChangedIsNamedByTheHashAlone) {
  const ScratchDirectory scratch;
  std::string bytes = read_text(write_result(scratch / "a.h5"));
  bytes[bytes.find("some words")] = 'S';
  write_bytes(scratch / "a.h5", bytes);
  EXPECT_THAT(refusal(scratch / "a.h5"), HasSubstr("its bytes are not those that were written"));
  EXPECT_THAT(refusal(scratch / "a.h5"), HasSubstr(CONTENT_HASH));
}

TEST(ContentHash, ANumberThatWasChangedIsNamedWithItsDataset) {
  const ScratchDirectory scratch;
  std::string bytes = read_text(write_result(scratch / "a.h5"));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write_bytes(scratch / "a.h5", bytes);
  EXPECT_THAT(refusal(scratch / "a.h5"), HasSubstr("/large: is damaged")) << "by HDF5's own checksum";
}

TEST(ContentHash, AnImageWithoutAPlaceForItIsAMistakeOfTheProgram) {
  EXPECT_THROW(with_content_hash("no place"), std::logic_error);
  const std::string twice = std::string(CONTENT_HASH_TO_COME) + CONTENT_HASH_TO_COME;
  EXPECT_THROW(with_content_hash(twice), std::logic_error);
}

}  // namespace
}  // namespace lmdbench
