// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_descriptor.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace lmdbench {

namespace {

[[noreturn]] void cannot_be(const std::filesystem::path& file, const char* action, int error) {
  throw EnvironmentError(file.string(), "",
                         fmt::format("cannot be {}: {}", action, std::generic_category().message(error)),
                         "check the disk space and the permissions of the folder");
}

/// A file that was not there before; removed at the end of the scope unless it was renamed.
class FreshFile {
 public:
  explicit FreshFile(const std::filesystem::path& beside) {
    constexpr int MOST_TRIES =
        1000;  // that many parts of killed processes with our number: something is wrong
    for (int i = 0; i < MOST_TRIES && !descriptor_.valid(); ++i) {
      name_ = beside.parent_path() / fmt::format(".{}.{}-{}.part", beside.filename().string(), ::getpid(), i);
      descriptor_ =
          FileDescriptor(::open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
      if (!descriptor_.valid() && errno != EEXIST) break;
    }
    if (!descriptor_.valid()) cannot_be(name_, "opened for writing", errno);
  }
  ~FreshFile() {
    if (!renamed_) ::unlink(name_.c_str());
  }
  FreshFile(const FreshFile&) = delete;
  FreshFile& operator=(const FreshFile&) = delete;

  void write(std::string_view content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_.get(), content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) cannot_be(name_, "written", errno);
      content.remove_prefix(static_cast<std::size_t>(written));
    }
    if (::fsync(descriptor_.get()) != 0) cannot_be(name_, "flushed to disk", errno);
  }

  int descriptor() const { return descriptor_.get(); }
  FileDescriptor take_descriptor() { return std::move(descriptor_); }

  void rename_to(const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::rename(name_, file, error);
    if (error) cannot_be(file, "replaced", error.value());
    renamed_ = true;
  }

 private:
  std::filesystem::path name_;
  FileDescriptor descriptor_;
  bool renamed_ = false;
};

}  // namespace

void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  FileDescriptor written = replace_file(file, content, {});
  if (!written.close()) cannot_be(file, "written", errno);
}

FileDescriptor replace_file(const std::filesystem::path& file, std::string_view content,
                            const std::function<void(int descriptor)>& before_rename) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  if (error) cannot_be(file.parent_path(), "made", error.value());
  FreshFile part(file);
  part.write(content);
  if (before_rename) before_rename(part.descriptor());
  part.rename_to(file);
  return part.take_descriptor();
}

}  // namespace lmdbench
