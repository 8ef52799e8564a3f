// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace lmdbench {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const char* action, int error) {
  throw EnvironmentError(file.string(), "", fmt::format("cannot be {}: {}", action, std::strerror(error)),
                         "check the disk space and the permissions of the folder");
}

void write_all(int descriptor, std::string_view content, const std::filesystem::path& file) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(file, "written", errno);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(descriptor) != 0) fail(file, "flushed to disk", errno);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  if (error) fail(file.parent_path(), "made", error.value());
  std::filesystem::path part = file;
  part += ".part";
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(part, "opened for writing", errno);
  try {
    write_all(descriptor, content, part);
  } catch (...) {
    ::close(descriptor);
    ::unlink(part.c_str());
    throw;
  }
  if (::close(descriptor) != 0) fail(part, "written", errno);
  std::filesystem::rename(part, file, error);
  if (error) fail(file, "replaced", error.value());
}

}  // namespace lmdbench
