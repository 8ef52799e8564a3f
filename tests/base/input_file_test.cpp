// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/input_file.h>

#include "support/message_of.h"
#include "support/scratch_directory.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::message_of;
using testing::ScratchDirectory;

TEST(InputFile, GivesTheBytesAndTheirHash) {
  const ScratchDirectory folder;
  const std::string bytes("a\0b\r\n\xFF", 6);
  const FileContent content = read_input_file(folder.write("f", bytes), {.what = "mesh"});
  EXPECT_EQ(content.bytes, bytes);
  EXPECT_EQ(content.sha256, sha256_of_text(bytes));
  EXPECT_EQ(read_input_file(folder.write("empty", ""), {.what = "mesh"}).bytes, "");
  std::filesystem::create_symlink(folder / "f", folder / "link");
  EXPECT_EQ(read_input_file(folder / "link", {.what = "mesh"}).bytes, bytes);
}

/// `..` beyond a link leads elsewhere than its name says.
TEST(InputFile, NamesAreShortenedToNamesOfTheSameFile) {
  const ScratchDirectory folder;
  const std::filesystem::path there = folder.write("elsewhere/mesh.off", "OFF\n");
  std::filesystem::create_directories(folder / "elsewhere" / "deep");
  std::filesystem::create_directories(folder / "here");
  std::filesystem::create_directory_symlink(folder / "elsewhere" / "deep", folder / "here" / "link");
  EXPECT_EQ(shortened(folder / "elsewhere" / "deep" / ".." / "mesh.off"), there);
  const std::filesystem::path linked = folder / "here" / "link" / ".." / "mesh.off";
  EXPECT_EQ(shortened(linked), linked);
  EXPECT_EQ(shortened(folder / "a" / ".." / "none.off"), folder / "none.off");
}

TEST(InputFile, RefusesWhatIsNoRegularFileWithoutWaiting) {
  const ScratchDirectory folder;
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  const auto message = [&](const std::filesystem::path& file) {
    return message_of<Error>([&] { read_input_file(file, {.what = "path", .code = ExitCode::USAGE}); });
  };
  EXPECT_THAT(message(folder / "fifo"), HasSubstr("is a FIFO, not a path"));
  EXPECT_THAT(message(folder.path()), HasSubstr("is a directory, not a path"));
  EXPECT_THAT(message("/dev/zero"), HasSubstr("is a device, not a path"));
  EXPECT_THAT(message(folder / "none"), AllOf(HasSubstr("none: cannot read"), HasSubstr("No such file")));
}

TEST(InputFile, SuggestsTheNameThatIsLikelyMeant) {
  const ScratchDirectory folder;
  std::filesystem::create_directories(folder / "meshes" / "scans");
  folder.write("meshes/scans/bunny.off", "OFF\n");
  const auto message = [&](const std::filesystem::path& file) {
    return message_of<Error>([&] { read_input_file(file, {.what = "mesh file"}); });
  };
  EXPECT_THAT(message(folder / "meshs/scans/bunny.off"), HasSubstr("there is no \"meshs\""));
  EXPECT_THAT(message(folder / "meshs/scans/bunny.off"), HasSubstr("did you mean \"meshes\"?"));
  EXPECT_THAT(message(folder / "meshes/scans/buny.off"), HasSubstr("did you mean \"bunny.off\"?"));
  EXPECT_THAT(message(folder / "meshes/scans/dragon.off"), HasSubstr("check the name"));
}

TEST(InputFile, NamesTheLimit) {
  const ScratchDirectory folder;
  const auto file = folder.write("f", std::string(11, 'x'));
  set_limit("json-bytes=10");
  const std::string message = message_of<Error>(
      [&] { read_input_file(file, {.what = "manifest", .most_bytes = Limit::JSON_BYTES}); });
  set_limit("json-bytes=16777216");
  EXPECT_THAT(message, AllOf(HasSubstr("limit of 10"), HasSubstr("--limit json-bytes=")));
}

TEST(InputFile, ReadsFilesThatTellNoSize) {
  // Files of /proc are regular, say 0 bytes and hold some.
  EXPECT_THAT(read_input_file("/proc/self/status", {.what = "file"}).bytes, HasSubstr("Name:"));
}

}  // namespace
}  // namespace lmdbench
