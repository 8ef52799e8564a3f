// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/output_guard.h>

#include "support/message_of.h"
#include "support/scratch_directory.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/files.h>
#include <support/full_disk.h>
#include <sys/stat.h>

#include <filesystem>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace lmdbench {
namespace {

namespace fs = std::filesystem;
using testing::FullDisk;
using ::testing::HasSubstr;
using testing::message_of;
using testing::read_text;
using testing::ScratchDirectory;

const OutputKind OURS{"note", [](const fs::path& file) { return file_begins_with(file, "ours"); }};

class OutputGuard : public ::testing::Test {
 protected:
  std::string refusal(const fs::path& file, const std::vector<fs::path>& inputs = {}) {
    return message_of<UsageError>([&] { refuse_unsafe_output(file, OURS, inputs, "--out"); });
  }
  ScratchDirectory folder_;
};

TEST_F(OutputGuard, AllowsFreeNamesEmptyFilesAndEarlierOutputs) {
  refuse_unsafe_output(folder_ / "free", OURS, {}, "--out");
  refuse_unsafe_output(folder_.write("empty", ""), OURS, {}, "--out");
  refuse_unsafe_output(folder_.write("old", "ours, too"), OURS, {folder_ / "other", folder_ / "none"},
                       "--out");
}

TEST_F(OutputGuard, AFolderIsNoFile) {
  refuse_no_folder(folder_ / "none", "--out");
  refuse_no_folder(folder_.path(), "--out");
  EXPECT_THAT(message_of<UsageError>([&] { refuse_no_folder(folder_.write("notes", "mine"), "--out"); }),
              HasSubstr("is no folder"));
  EXPECT_THAT(message_of<EnvironmentError>([&] { refuse_no_folder(folder_ / "notes/new/one", "--out"); }),
              HasSubstr("notes is a file (remedy: name another folder with --out)"));
}

TEST_F(OutputGuard, RefusesInputsByAnyName) {
  const fs::path input = folder_.write("input", "ours");
  EXPECT_THAT(refusal(input, {input}), HasSubstr("is also read"));
  EXPECT_THAT(refusal(folder_ / "." / "input", {input}), HasSubstr("is also read"));
  fs::create_hard_link(input, folder_ / "hard");
  EXPECT_THAT(refusal(folder_ / "hard", {input}), HasSubstr("is also read"));
  fs::create_symlink(input, folder_ / "link");
  EXPECT_THAT(refusal(input, {folder_ / "link"}), HasSubstr("is also read"));
}

TEST_F(OutputGuard, RefusesWhatIsNoFileOfOurs) {
  EXPECT_THAT(refusal(folder_.write("notes.txt", "mine")), HasSubstr("no note of lmdbench"));
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("directory"));
  EXPECT_THAT(refusal("/dev/null"), HasSubstr("device"));
  EXPECT_THAT(refusal(folder_ / ""), HasSubstr("names no file"));
  ASSERT_EQ(::mkfifo((folder_ / "fifo").c_str(), 0600), 0);
  EXPECT_THAT(refusal(folder_ / "fifo"), HasSubstr("FIFO"));
  fs::create_symlink(folder_.write("target", "ours"), folder_ / "link");
  EXPECT_THAT(refusal(folder_ / "link"), HasSubstr("symbolic link"));
  fs::create_symlink(folder_ / "nowhere", folder_ / "dangling");
  EXPECT_THAT(refusal(folder_ / "dangling"), HasSubstr("symbolic link"));
}

TEST_F(OutputGuard, RefusesStandardOutput) {
  EXPECT_THAT(refusal("-"), HasSubstr("--out -: \"-\" stands for standard output"));
  refuse_unsafe_output("./-", OURS, {}, "--out");
}

TEST(AtomicFile, LeavesNoPartAndFollowsNoLink) {
  const ScratchDirectory folder;
  folder.write("victim", "mine");
  fs::create_symlink(folder / "victim", folder / "out");
  write_file_atomically(folder / "out", "new");
  EXPECT_EQ(read_text(folder / "victim"), "mine");
  EXPECT_EQ(read_text(folder / "out"), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 2)
      << "no part left";
}

TEST(AtomicFile, WritersOfOneNameDoNotMeet) {
  const ScratchDirectory folder;
  const std::string a(1 << 20, 'a'), b(1 << 20, 'b');
  std::thread other([&] {
    for (int i = 0; i < 20; ++i) write_file_atomically(folder / "out", a);
  });
  for (int i = 0; i < 20; ++i) write_file_atomically(folder / "out", b);
  other.join();
  const std::string left = read_text(folder / "out");
  EXPECT_TRUE(left == a || left == b);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(AtomicFile, AFullDiskIsAnErrorAndLeavesTheOldFile) {
  const ScratchDirectory folder;
  write_file_atomically(folder / "out", "old");
  {
    const FullDisk full(1024);
    EXPECT_THROW(write_file_atomically(folder / "out", std::string(1 << 20, 'n')), EnvironmentError);
  }
  EXPECT_EQ(read_text(folder / "out"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1)
      << "no part left";
  EXPECT_THROW(write_file_atomically("/proc/no-such-file", "x"), EnvironmentError);
}

}  // namespace
}  // namespace lmdbench
