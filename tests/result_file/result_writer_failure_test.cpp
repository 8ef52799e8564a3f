// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_descriptor.h>
#include <lmdbench/result_file/result_writer.h>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <result_file/result_reading.h>
#include <support/full_disk.h>
#include <support/message_of.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <thread>

namespace lmdbench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using testing::FullDisk;
using ::testing::HasSubstr;
using testing::OpenResult;
using testing::ScratchDirectory;

/// The message that the user gets when `action` fails as it should.
std::string complaint(const std::function<void()>& action) {
  return testing::message_of<EnvironmentError>(action);
}

void write_one(const std::filesystem::path& file, double value) {
  ResultWriter writer(file);
  writer.write({"/a", "m", "a value"}, std::vector<double>{value}, {1});
  writer.commit();
}

TEST(ResultWriterFailure, MakesMissingDirectories) {
  const ScratchDirectory directory;
  write_one(directory / "not/yet/there.h5", 4.0);
  EXPECT_THAT(OpenResult(directory / "not/yet/there.h5").doubles("/a"), ElementsAre(4.0));
}

TEST(ResultWriterFailure, NamesAFileThatStandsWhereADirectoryShould) {
  const ScratchDirectory directory;
  std::ofstream(directory / "file") << "text";
  EXPECT_THAT(complaint([&] { ResultWriter writer(directory / "file/a.h5"); }),
              AllOf(HasSubstr("/file"), HasSubstr("Not a directory"), HasSubstr("--out")));
}

TEST(ResultWriterFailure, RefusesADirectoryAsResult) {
  const ScratchDirectory directory;
  std::filesystem::create_directory(directory / "a.h5");
  EXPECT_THAT(complaint([&] { ResultWriter writer(directory / "a.h5"); }),
              AllOf(HasSubstr("a.h5"), HasSubstr("is a directory")));
  EXPECT_THAT(complaint([&] { ResultWriter writer(directory / "new/"); }), HasSubstr("names no file"));
  EXPECT_FALSE(std::filesystem::exists(directory / "a.h5.part"));
}

TEST(ResultWriterFailure, NamesAPlaceThatCannotBeWritten) {
  // /proc refuses new files even to root.
  EXPECT_THAT(complaint([&] { ResultWriter writer("/proc/lmdbench-result.h5"); }),
              AllOf(HasSubstr("/proc/lmdbench-result.h5.part"), HasSubstr("--out")));
}

/// A killed run's lock may last a moment longer, in a process that reads the part file for it.
TEST(ResultWriterFailure, WaitsAMomentForTheLock) {
  const ScratchDirectory directory;
  const std::string part = directory / "a.h5.part";
  std::ofstream(part).flush();
  FileDescriptor holder(::open(part.c_str(), O_RDWR | O_CLOEXEC));
  struct flock lock {};
  lock.l_type = F_WRLCK;
  ASSERT_EQ(::fcntl(holder.get(), F_OFD_SETLK, &lock), 0);
  std::thread release([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    holder = FileDescriptor();
  });
  EXPECT_NO_THROW(write_one(directory / "a.h5", 3.0));
  release.join();
  EXPECT_THAT(OpenResult(directory / "a.h5").doubles("/a"), ElementsAre(3.0));
}

TEST(ResultWriterFailure, RefusesASecondWriterOfTheSameResult) {
  const ScratchDirectory directory;
  ResultWriter first(directory / "a.h5");
  first.write({"/a", "m", "a value"}, std::vector<double>{1.0}, {1});
  EXPECT_THAT(complaint([&] { ResultWriter second(directory / "a.h5"); }),
              AllOf(HasSubstr("a.h5.part"), HasSubstr("another run")));
  first.commit();
  EXPECT_THAT(OpenResult(directory / "a.h5").doubles("/a"), ElementsAre(1.0));
  write_one(directory / "a.h5", 2.0);
  EXPECT_THAT(OpenResult(directory / "a.h5").doubles("/a"), ElementsAre(2.0));
}

/// Random samples do not compress.
void write_much(ResultWriter& writer) {
  std::vector<double> samples(100'000);
  for (double& sample : samples) sample = std::rand();
  writer.write({"/samples", "s", "more than fits"}, samples, {samples.size()});
}

TEST(ResultWriterFailure, AFullDiskLeavesTheEarlierResult) {
  const ScratchDirectory directory;
  write_one(directory / "a.h5", 1.0);
  {
    ResultWriter writer(directory / "a.h5");
    write_much(writer);
    const FullDisk full(64 * 1024);
    EXPECT_THAT(complaint([&] { writer.commit(); }),
                AllOf(HasSubstr("a.h5"), HasSubstr("File too large"), HasSubstr("disk space")));
  }
  EXPECT_THAT(OpenResult(directory / "a.h5").doubles("/a"), ElementsAre(1.0));
  for (const auto& entry : std::filesystem::directory_iterator(directory / ""))
    EXPECT_LT(entry.file_size(), 64 * 1024) << entry.path() << ": a failed commit gives the space back";
}

TEST(ResultWriterFailure, CommitWorksOnceThereIsSpaceAgain) {
  const ScratchDirectory directory;
  ResultWriter writer(directory / "a.h5");
  write_much(writer);
  {
    const FullDisk full(64 * 1024);
    EXPECT_THROW(writer.commit(), EnvironmentError);
  }
  writer.commit();
  EXPECT_EQ(OpenResult(directory / "a.h5").doubles("/samples").size(), 100'000u);
}

TEST(ResultWriterFailure, Hdf5PrintsNothing) {
  // HDF5 would print its own errors with every failed call, and again as the process ends.
  EXPECT_EXIT(
      {
        {
          const ScratchDirectory directory;
          ResultWriter writer(directory / "a.h5");
          writer.write({"/a", "m", "a value"}, std::vector<double>{1.0}, {1});
          // A dataset cannot hold others: HDF5 refuses.
          complaint([&] { writer.write({"/a/b", "m", "inside"}, std::vector<double>{1.0}, {1}); });
          complaint([&] { writer.attribute("/a/b", "name", std::int64_t{1}); });
        }
        std::exit(0);
      },
      ::testing::ExitedWithCode(0), "^$");
}

}  // namespace
}  // namespace lmdbench
