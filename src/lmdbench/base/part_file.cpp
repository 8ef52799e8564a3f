// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_descriptor.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/base/part_file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

namespace lmdbench {

namespace {

std::string error_text(int error) {
  return std::generic_category().message(error);
}

std::string remedy_for(int error) {
  switch (error) {
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place that you may write to with --out";
    case ENOSPC:
    case EDQUOT:
      return "free disk space or choose another place with --out";
    default:
      return "choose another place with --out";
  }
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what, int error) {
  throw EnvironmentError(file.string(), "", what + ": " + error_text(error), remedy_for(error));
}

/// The directory that holds a file; "." for a bare name.
std::filesystem::path directory_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

void refuse_directory(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw EnvironmentError(file.string(), "", "is a directory, not a result file",
                           "name a file in it, for example " + (file / "result.h5").string());
  }
}

/// Whether an interrupted run may have left this: nothing yet, or the start of a result file.
bool looks_like_a_part(const std::filesystem::path& part) {
  constexpr std::string_view HDF5_SIGNATURE = "\x89HDF\r\n\x1a\n";
  const std::string head = first_bytes(part);
  return head.empty() || head.starts_with(HDF5_SIGNATURE);
}

/// A process that reads the part for a killed run still holds the lock, but ends a moment later.
bool lock_in_time(int descriptor) {
  constexpr std::chrono::milliseconds LONGEST_WAIT{1000}, PAUSE{10};
  for (auto waited = PAUSE; !lock_whole_file(descriptor); waited += PAUSE) {
    if (waited > LONGEST_WAIT) return false;
    std::this_thread::sleep_for(PAUSE);
  }
  return true;
}

}  // namespace

PartFile::PartFile(std::filesystem::path final_name) : final_name_(std::move(final_name)) {
  if (!final_name_.has_filename()) {
    throw EnvironmentError(final_name_.string(), "", "names no file", "end --out with a file name");
  }
  refuse_directory(final_name_);
  part_name_ = final_name_;
  part_name_ += ".part";
  refuse_directory(part_name_);
  std::error_code error;
  std::filesystem::create_directories(directory_of(final_name_), error);
  if (error) fail(directory_of(final_name_), "the directory of the result cannot be made", error.value());
  open_and_lock();
}

void PartFile::open_and_lock() {
  // A run may rename the file that we hold between our open and our lock: then open the new one.
  while (true) {
    // New, or left by an earlier run: never through a link, never into a file of somebody else.
    const auto open = [this](int flags) {
      descriptor_ = FileDescriptor(::open(part_name_.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | flags, 0666));
    };
    open(O_CREAT | O_EXCL);
    if (!descriptor_.valid() && errno == EEXIST) {
      open(O_NONBLOCK);
      if (!descriptor_.valid() && errno == ENOENT) continue;  // its run ended just now
    }
    if (!descriptor_.valid()) fail(part_name_, "the result cannot be written", errno);
    if (!lock_in_time(descriptor_.get())) {
      throw EnvironmentError(part_name_.string(), "", "another run is writing this result",
                             "wait for it or choose another file with --out");
    }
    struct stat ours {};
    struct stat named {};
    if (::fstat(descriptor_.get(), &ours) != 0) fail(part_name_, "the result cannot be written", errno);
    const bool same = ::lstat(part_name_.c_str(), &named) == 0 && ours.st_ino == named.st_ino &&
                      ours.st_dev == named.st_dev;
    if (same && S_ISREG(ours.st_mode) && ours.st_nlink == 1 && looks_like_a_part(part_name_)) return;
    if (same) refuse_foreign();
  }
}

void PartFile::refuse_foreign() const {
  throw EnvironmentError(part_name_.string(), "",
                         "stands where the result is written at first, and is no part of a run of lmdbench",
                         "move it away or choose another place with --out");
}

bool PartFile::is_empty() const {
  struct stat status {};
  return ::fstat(descriptor_.get(), &status) == 0 && status.st_size == 0;
}

void PartFile::write(std::string_view content) {
  // Locked before it takes the name, so that the part is ours at any moment.
  FileDescriptor replacement = replace_file(part_name_, content, [](int file) { lock_whole_file(file); });
  descriptor_ = std::move(replacement);
}

void PartFile::remove() {
  // Later the name may be another run's.
  if (!std::exchange(removed_, true)) ::unlink(part_name_.c_str());
}

void PartFile::publish(std::string_view content) {
  refuse_directory(final_name_);
  write_file_atomically(final_name_, content);
  // The rename is durable only when its directory is on the disk. Some file systems refuse that; it
  // is no error, because the result is complete and named by then.
  const int directory = ::open(directory_of(final_name_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory >= 0) {
    static_cast<void>(::fsync(directory));
    ::close(directory);
  }
  remove();
}

}  // namespace lmdbench
