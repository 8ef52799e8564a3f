// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace lmdbench {

/// The remedy for a mesh file that is shorter than its header says.
inline constexpr const char* CUT_SHORT =
    "the file may be cut short: get it again, or correct the counts in its header";

/// The remedy for one that is longer.
inline constexpr const char* TOO_LONG = "correct the counts in its header, or get the file again";

/// Lines of a mesh in text, without comments (# to the end, but not that of "1.#INF") and blank
/// lines, and their numbers.
class LineReader {
 public:
  /// @param lines_before lines of the file before the text
  LineReader(std::string file, std::string_view text, std::size_t lines_before = 0)
      : file_(std::move(file)), rest_(text), line_number_(lines_before) {}

  /// Goes to the next line with content.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      line_ = rest_.substr(0, end);
      rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
      ++line_number_;
      line_ = line_.substr(0, comment_of(line_));
      skip_blanks();
      if (!line_.empty()) return true;
    }
    return false;
  }

  /// The next word of the line; empty at its end.
  std::string_view word() {
    const std::string_view result = line_.substr(0, line_.find_first_of(BLANKS));
    line_.remove_prefix(result.size());
    skip_blanks();
    return result;
  }

  template <typename Number>
  Number number(const char* what) {
    return number<Number>(what, word());
  }

  /// The nearest number of single precision; 0 below its least one.
  double single(const char* what) {
    const std::string_view text = word(), digits = without_plus(text);
    float nearest = 0.0F;  // by way of double precision it would be rounded twice
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), nearest);
    const bool is_read = error == std::errc{} && end == digits.data() + digits.size();
    return static_cast<double>(is_read ? nearest : static_cast<float>(number<double>(what, text)));
  }

  /// @param what the number is, for messages
  /// @throws InputError naming the line, unless the text is a number and nothing else
  template <typename Number>
  Number number(const char* what, std::string_view text) const {
    if (text.empty()) fail(fmt::format("{} is missing", what));
    text = without_plus(text);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) fail(fmt::format("{} '{}' is out of range", what, text));
    if (error != std::errc{} || end != text.data() + text.size())
      fail(fmt::format("{} '{}' is not a {}number", what, text, std::is_integral_v<Number> ? "whole " : ""));
    return value;
  }

  bool begins_with(std::string_view start) const { return line_.starts_with(start); }
  bool ends_with(std::string_view end) const { return line_.ends_with(end); }
  bool at_line_end() const { return line_.empty(); }
  /// What of the line was not read yet.
  std::string_view rest() const { return line_; }
  std::size_t line_number() const { return line_number_; }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy = "correct the line") const {
    throw InputError(file_, fmt::format("line {}", line_number_), problem, remedy);
  }

 private:
  static constexpr std::string_view BLANKS = " \t\r";
  static constexpr std::array<std::string_view, 8> NO_NUMBERS{"INF", "IND", "QNAN", "SNAN",
                                                              "inf", "ind", "qnan", "snan"};

  static std::string_view without_plus(std::string_view text) {
    return text.substr(text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  }

  static std::size_t comment_of(std::string_view line) {
    std::size_t at = line.find('#');
    const auto is_no_number = [&] {  // of old compilers
      return at >= 2 && line.substr(at - 2, 2) == "1." &&
             std::ranges::any_of(NO_NUMBERS, [&](auto end) { return line.substr(at + 1).starts_with(end); });
    };
    while (at != std::string_view::npos && is_no_number()) at = line.find('#', at + 1);
    return at;
  }

  void skip_blanks() { line_.remove_prefix(std::min(line_.size(), line_.find_first_not_of(BLANKS))); }

  std::string file_;
  std::string_view rest_, line_;
  std::size_t line_number_;
};

}  // namespace lmdbench
