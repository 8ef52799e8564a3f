// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_descriptor.h>
#include <lmdbench/base/output_guard.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lmdbench {

void refuse_standard_output(const std::filesystem::path& file, const std::string& what,
                            const std::string& option) {
  if (file != "-") return;
  throw UsageError("", fmt::format("{} -", option),
                   fmt::format("\"-\" stands for standard output, and a {} is not written there", what),
                   fmt::format("name a file with {}, or ./- for one of this name", option));
}

void refuse_no_folder(const std::filesystem::path& folder, const std::string& option) {
  if (folder.empty())
    throw UsageError("", option, "names no folder", "name one: it is made where there is none");
  for (std::filesystem::path part = folder; !part.empty(); part = part.parent_path()) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(part, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_directory(status)) {
      if (part == folder)
        throw UsageError(folder.string(), option, "is no folder",
                         "name a folder: it is made where there is none");
      throw EnvironmentError(folder.string(), "", fmt::format("cannot be made: {} is a file", part.string()),
                             fmt::format("name another folder with {}", option));
    }
    if (std::filesystem::exists(status) || part == part.parent_path()) return;
  }
}

void refuse_unsafe_output(const std::filesystem::path& file, const OutputKind& kind,
                          const std::vector<std::filesystem::path>& inputs, const std::string& option) {
  const std::string remedy = fmt::format("choose another name with {}", option);
  const auto refuse = [&](const std::string& problem, const std::string& other_remedy) {
    throw UsageError(file.string(), option, problem, other_remedy);
  };
  if (!file.has_filename()) refuse("names no file", fmt::format("end {} with a file name", option));
  refuse_standard_output(file, kind.what, option);
  struct stat there {};
  if (::lstat(file.c_str(), &there) != 0) return;  // free, or a problem that opening will tell
  for (const std::filesystem::path& input : inputs) {
    struct stat of_input {};
    if (::stat(input.c_str(), &of_input) == 0 && of_input.st_ino == there.st_ino &&
        of_input.st_dev == there.st_dev)
      refuse(fmt::format("is also read, as {}: the {} would replace it", input.string(), kind.what), remedy);
  }
  if (S_ISDIR(there.st_mode))
    refuse(fmt::format("is a directory, not a {}", kind.what),
           fmt::format("name a file in it, for example {}", (file / "file").string()));
  if (S_ISLNK(there.st_mode))
    refuse("is a symbolic link, which is neither followed nor replaced", "name the file itself");
  if (!S_ISREG(there.st_mode)) refuse("is a device, FIFO or socket: no regular file", remedy);
  if (there.st_size > 0 && !kind.is_ours(file))
    refuse(fmt::format("is there already and is no {} of lmdbench: it is not replaced", kind.what),
           remedy + ", or move that file away");
}

std::string first_bytes(const std::filesystem::path& file) {
  const FileDescriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat status {};
  if (!descriptor.valid() || ::fstat(descriptor.get(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  std::string bytes(4096, '\0');
  const ssize_t count = ::read(descriptor.get(), bytes.data(), bytes.size());
  bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return bytes;
}

bool file_begins_with(const std::filesystem::path& file, std::string_view start) {
  return first_bytes(file).starts_with(start);
}

}  // namespace lmdbench
