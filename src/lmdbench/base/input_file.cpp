// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/file_descriptor.h>
#include <lmdbench/base/file_hash.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/json_schema.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace lmdbench {
namespace {

/// The kind of a file that is not regular; "no regular file" for an exotic one.
const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a FIFO";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  if (S_ISSOCK(mode)) return "a socket";
  return "no regular file";
}

/// Remedy for a missing file: the first part of its path that does not exist, and the name there
/// that is likely meant; empty without one.
std::string likely_name(const std::filesystem::path& file) {
  constexpr std::size_t MOST_NAMES = 10000;
  std::filesystem::path here = file.is_absolute() ? "" : ".";
  std::error_code error;
  for (const std::filesystem::path& part : file) {
    if (std::filesystem::exists(here / part, error)) {
      here /= part;
      continue;
    }
    std::vector<std::string> names;
    for (std::filesystem::directory_iterator entry(here, error), end;
         !error && entry != end && names.size() < MOST_NAMES; entry.increment(error))
      names.push_back(entry->path().filename().string());
    const std::string near = nearest_word(part.string(), names);
    return near.empty()
               ? ""
               : fmt::format("there is no \"{}\" in {}: did you mean \"{}\"?", part.string(),
                             std::filesystem::absolute(here, error).lexically_normal().string(), near);
  }
  return {};
}

/// The errors about one file.
struct Refusal {
  const std::filesystem::path& file;
  const InputKind& kind;

  [[noreturn]] void operator()(const std::string& problem, const std::string& remedy) const {
    if (kind.code == ExitCode::USAGE) throw UsageError(file.string(), "", problem, remedy);
    throw InputError(file.string(), "", problem, remedy);
  }
  [[noreturn]] void unreadable(int error) const {
    const std::string hint = error == ENOENT ? likely_name(file) : "";
    (*this)(fmt::format("cannot read the {}: {}", kind.what, std::generic_category().message(error)),
            hint.empty() ? kind.remedy : hint);
  }
  void unless_regular(const struct stat& status) const {
    if (!S_ISREG(status.st_mode))
      (*this)(fmt::format("is {}, not a {}", kind_of(status.st_mode), kind.what), "name a regular file");
  }
};

}  // namespace

void refuse_unless_regular(const std::filesystem::path& file, const InputKind& kind) {
  const Refusal refuse{file, kind};
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) refuse.unreadable(errno);
  refuse.unless_regular(status);
}

std::filesystem::path shortened(const std::filesystem::path& file) {
  std::filesystem::path normal = file.lexically_normal();
  std::error_code none;
  const bool differs =
      std::filesystem::exists(file, none) && !std::filesystem::equivalent(file, normal, none);
  return differs ? file : normal;
}

FileContent read_input_file(const std::filesystem::path& file, const InputKind& kind) {
  const Refusal refuse{file, kind};
  // Checked before it is opened: opening alone can make a device act.
  refuse_unless_regular(file, kind);
  // Not blocking: between the two calls a FIFO may have taken the name.
  const FileDescriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!descriptor.valid()) refuse.unreadable(errno);
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) refuse.unreadable(errno);
  refuse.unless_regular(status);
  const std::int64_t most = limit_of(kind.most_bytes);
  const auto refuse_large = [&](std::int64_t size) {
    if (size > most)
      refuse(fmt::format("has {} bytes or more, above the limit of {} for a {}", size, most, kind.what),
             "check that it is the right file, or " + raise_remedy(kind.most_bytes));
  };
  refuse_large(status.st_size);

  FileContent input{file, std::string(static_cast<std::size_t>(status.st_size), '\0'), {}};
  std::array<char, 4096> beyond;  // a file that still grows is read to its end
  std::size_t length = 0;
  for (;;) {
    const bool in_place = length < input.bytes.size();
    char* target = in_place ? input.bytes.data() + length : beyond.data();
    const ssize_t count =
        ::read(descriptor.get(), target, in_place ? input.bytes.size() - length : beyond.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse.unreadable(errno);
    if (count == 0) break;
    if (!in_place) input.bytes.append(beyond.data(), static_cast<std::size_t>(count));
    length += static_cast<std::size_t>(count);
    refuse_large(static_cast<std::int64_t>(length));
  }
  input.bytes.resize(length);
  input.sha256 = sha256_of_text(input.bytes);
  return input;
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view MARK = "\xEF\xBB\xBF";
  return text.substr(text.starts_with(MARK) ? MARK.size() : 0);
}

namespace {

/// Such a cell would shift all behind it.
bool has_empty_cell(const std::string& line) {
  const auto is_blank = [](std::string_view cell) {
    return cell.find_first_not_of(" \t\r\v\f") == std::string_view::npos;
  };
  std::string_view rest = line;
  bool empty = false;
  for (auto comma = rest.find(','); comma != std::string_view::npos; comma = rest.find(',')) {
    empty = empty || is_blank(rest.substr(0, comma));
    rest.remove_prefix(comma + 1);
    empty = empty || is_blank(rest);
  }
  return empty;
}

}  // namespace

void for_each_number_line(
    const std::string& text, const std::string& name, const std::string& remedy,
    const std::function<void(const std::string& place, std::span<const double> numbers)>& use) {
  std::istringstream lines{std::string(without_byte_order_mark(text))};
  std::vector<double> numbers;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string place = fmt::format("line {}", ++number);
    line.resize(std::min(line.find('#'), line.size()));
    if (has_empty_cell(line)) throw InputError(name, place, "nothing before or behind a comma", remedy);
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    numbers.clear();
    for (std::string word; words >> word;) {
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (*end != '\0' || !std::isfinite(value))
        throw InputError(name, place, fmt::format("\"{}\" is no finite number", word), remedy);
      numbers.push_back(value);
    }
    if (!numbers.empty()) use(place, numbers);
  }
}

}  // namespace lmdbench
