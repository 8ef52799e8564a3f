// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_descriptor.h>
#include <lmdbench/base/output_guard.h>
#include <lmdbench/sweep/journal.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace lmdbench {
namespace {

using Json = nlohmann::json;

constexpr const char* FORMAT = "lmdbench-sweep-journal-1";
const std::string FIRST_LINE = std::string("{\"format\":\"") + FORMAT + "\"}\n";

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw EnvironmentError(file.string(), "", std::string("cannot be written: ") + std::strerror(errno),
                         "check the disk and the permissions");
}

}  // namespace

bool is_own_journal(const std::filesystem::path& file) {
  return file_begins_with(file, FIRST_LINE);
}

Journal::Journal(std::filesystem::path file) : file_(std::move(file)) {
  std::ifstream stream(file_, std::ios::binary);
  std::string line;
  std::uintmax_t whole = 0;  // bytes up to the end of the last whole line
  while (std::getline(stream, line) && !stream.eof()) {
    whole += line.size() + 1;
    Json entry = Json::parse(line, nullptr, false);
    const bool ours = entry.is_object() && entry.contains("key") && entry["key"].is_string() &&
                      entry.contains("repetition") && entry["repetition"].is_number_integer();
    if (!ours) continue;
    const std::pair place{entry["key"].get<std::string>(), entry["repetition"].get<std::int64_t>()};
    entries_[place] = std::move(entry);
  }
  stream.close();
  // The next line must not be written behind half a one.
  std::error_code ignored;
  if (std::filesystem::exists(file_, ignored)) std::filesystem::resize_file(file_, whole, ignored);
}

const Json* Journal::find(const std::string& key, std::int64_t repetition) const {
  const auto found = entries_.find({key, repetition});
  return found == entries_.end() ? nullptr : &found->second;
}

void Journal::append(Json entry) {
  const FileDescriptor descriptor(
      ::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (descriptor.get() < 0) fail(file_);
  std::string text = ::lseek(descriptor.get(), 0, SEEK_END) == 0 ? FIRST_LINE : "";
  text += entry.dump() + "\n";
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor.get(), text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(file_);
    done += static_cast<std::size_t>(written);
  }
  if (::fsync(descriptor.get()) != 0) fail(file_);
  const std::pair place{entry["key"].get<std::string>(), entry["repetition"].get<std::int64_t>()};
  entries_[place] = std::move(entry);
}

}  // namespace lmdbench
