// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/json_place.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace lmdbench {
namespace {

/// Walks through well-formed JSON and notes the line of each value.
class LineFinder {
 public:
  explicit LineFinder(const std::string& text) : text_(text) {}

  int find(const std::string& pointer) {
    wanted_ = pointer;
    value("");
    return line_;
  }

 private:
  /// The value at `here`. Enclosing values come first, so that the last match is the nearest one.
  void value(const std::string& here) {
    skip_blanks();
    if (wanted_ == here || wanted_.starts_with(here + "/"))
      line_ = 1 + static_cast<int>(
                      std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n'));
    if (text_[at_] == '{' || text_[at_] == '[') {
      container(here);
    } else if (text_[at_] == '"') {
      string();
    } else {
      at_ = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
    }
  }

  void container(const std::string& here) {
    const bool object = text_[at_++] == '{';
    for (std::size_t index = 0; skip_blanks(), text_[at_] != '}' && text_[at_] != ']'; ++index) {
      if (text_[at_] == ',') skip_one_and_blanks();
      std::string step = std::to_string(index);
      if (object) {
        step = escaped(string());
        skip_blanks();
        skip_one_and_blanks();  // the colon
      }
      value(here + "/" + step);
    }
    ++at_;
  }

  /// The string that begins here, with its escapes resolved.
  std::string string() {
    const std::size_t begin = at_++;
    while (text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    ++at_;
    return nlohmann::json::parse(text_.substr(begin, at_ - begin)).get<std::string>();
  }

  /// A key as a step of a JSON pointer (RFC 6901).
  static std::string escaped(const std::string& key) {
    std::string step;
    for (const char c : key) step += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return step;
  }

  void skip_blanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }
  void skip_one_and_blanks() {
    ++at_;
    skip_blanks();
  }

  const std::string& text_;
  std::string wanted_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

int line_of(const std::string& text, const std::string& pointer) {
  return LineFinder(text).find(pointer == "/" ? "" : pointer);
}

}  // namespace lmdbench
