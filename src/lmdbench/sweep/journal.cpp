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

/// What follows could not be told from the end of the file, where the next line is written.
[[noreturn]] void fail_to_read(const std::filesystem::path& file) {
  throw EnvironmentError(file.string(), "", "cannot be read to its end",
                         "check the disk and the permissions; nothing was changed");
}

[[noreturn]] void fail_to_write(const std::filesystem::path& file) {
  throw EnvironmentError(file.string(), "", std::string("cannot be written: ") + std::strerror(errno),
                         "check the disk and the permissions");
}

bool has_text(const Json& line, const char* name) {
  return line.contains(name) && line[name].is_string();
}

}  // namespace

bool is_own_journal(const std::filesystem::path& file) {
  return file_begins_with(file, FIRST_LINE);
}

Journal::Journal(std::filesystem::path file) : file_(std::move(file)) {
  whole_ = read(file_);
}

void Journal::read_also(const std::filesystem::path& other) {
  if (is_own_journal(other)) read(other);
}

std::uintmax_t Journal::read(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::status(file, ignored).type() == std::filesystem::file_type::not_found) return 0;
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  std::uintmax_t whole = 0;
  while (std::getline(stream, line) && !stream.eof()) {
    whole += line.size() + 1;
    remember(Json::parse(line, nullptr, false), file);
  }
  if (!stream.is_open() || stream.bad()) fail_to_read(file);
  return whole;
}

void Journal::remember(Json line, const std::filesystem::path& file) {
  if (!line.is_object()) return;
  if (has_text(line, "failed") && has_text(line, "why")) {
    failures_[line["failed"].get<std::string>()] = line["why"].get<std::string>();
    return;
  }
  if (has_text(line, "discarded")) {
    const auto key = line["discarded"].get<std::string>();
    std::erase_if(entries_, [&](const auto& entry) { return entry.first.first == key; });
    return;
  }
  if (!line.contains("repetition") || !line["repetition"].is_number_integer()) return;
  const auto repetition = line["repetition"].get<std::int64_t>();
  if (has_text(line, "began")) {
    Json& where = line["where"];
    begun_[{line["began"].get<std::string>(), repetition}].push_back(std::move(where));
  } else if (has_text(line, "key")) {
    const auto key = line["key"].get<std::string>();
    failures_.erase(key);
    entries_.try_emplace({key, repetition}, Entry{std::move(line), file});
  }
}

const Json* Journal::find(const std::string& key, std::int64_t repetition) const {
  const auto found = entries_.find({key, repetition});
  return found == entries_.end() ? nullptr : &found->second.line;
}

const std::filesystem::path& Journal::file_of(const std::string& key, std::int64_t repetition) const {
  return entries_.at({key, repetition}).file;
}

const std::vector<Json>& Journal::begun(const std::string& key, std::int64_t repetition) const {
  static const std::vector<Json> never;
  const auto found = begun_.find({key, repetition});
  return found == begun_.end() ? never : found->second;
}

const std::string* Journal::failure(const std::string& key) const {
  const auto found = failures_.find(key);
  return found == failures_.end() ? nullptr : &found->second;
}

void Journal::append(Json entry) {
  write(std::move(entry));
}

void Journal::begin(const std::string& key, std::int64_t repetition, Json where) {
  write({{"began", key}, {"repetition", repetition}, {"where", std::move(where)}});
}

void Journal::fail(const std::string& key, const std::string& why) {
  write({{"failed", key}, {"why", why}});
}

void Journal::discard(const std::string& key) {
  write({{"discarded", key}});
}

void Journal::write(Json line) {
  const FileDescriptor descriptor(
      ::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (descriptor.get() < 0 || ::ftruncate(descriptor.get(), static_cast<off_t>(whole_)) != 0)
    fail_to_write(file_);
  std::string text = whole_ == 0 ? FIRST_LINE : "";
  // Names of programs and files may contain any bytes.
  text += line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor.get(), text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail_to_write(file_);
    done += static_cast<std::size_t>(written);
  }
  if (::fsync(descriptor.get()) != 0) fail_to_write(file_);
  whole_ += text.size();
  remember(std::move(line), file_);
}

}  // namespace lmdbench
