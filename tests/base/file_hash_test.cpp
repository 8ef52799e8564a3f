// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_hash.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace lmdbench {
namespace {

TEST(FileHashTest, AgreesWithThePublishedVectors) {
  // FIPS 180-2, appendix B.1 and B.3, and the empty message.
  const auto file = std::filesystem::path(::testing::TempDir()) / "file_hash_test.bin";
  std::ofstream(file, std::ios::binary) << "abc";
  EXPECT_EQ(sha256_of_file(file), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  std::ofstream(file, std::ios::binary) << std::string(1000000, 'a');
  EXPECT_EQ(sha256_of_file(file), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  std::ofstream(file, std::ios::binary) << "";
  EXPECT_EQ(sha256_of_file(file), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  std::filesystem::remove(file);
}

TEST(FileHashTest, NamesWhatItCannotRead) {
  EXPECT_THROW(sha256_of_file("/nonexistent/file"), InputError);
  EXPECT_THROW(sha256_of_file(::testing::TempDir()), InputError);
}

}  // namespace
}  // namespace lmdbench
