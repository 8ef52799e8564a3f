// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/obj_check.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace lmdbench {
namespace {

/// Bytes of a line, for each corner that a polygon may have: three indices of ten digits, and signs between.
constexpr std::int64_t BYTES_PER_CORNER = 40;

std::int64_t word_count(std::string_view line) {
  std::int64_t count = 0;
  bool in_word = false;
  for (const char c : line) {
    const bool blank = c == ' ' || c == '\t' || c == '\r' || c == '\\';
    if (!blank && !in_word) ++count;
    in_word = !blank;
  }
  return count;
}

}  // namespace

void check_obj(std::string_view text, const std::string& file) {
  const std::int64_t most_corners = limit_of(Limit::POLYGON_CORNERS);
  std::int64_t corners = 0;  // of the face under way: a backslash at a line's end continues it
  std::int64_t length = 0;   // of the lines so joined
  bool in_face = false;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (length == 0) {
      const std::string_view word = line.substr(std::min(line.size(), line.find_first_not_of(" \t")));
      in_face = word.starts_with("f ") || word.starts_with("f\t") || word == "f" || word.starts_with("f\\");
      corners = -1;  // the keyword is a word, too
    }
    corners += word_count(line);
    length += static_cast<std::int64_t>(line.size());
    const auto fail = [&](const std::string& problem) {
      throw InputError(
          file, fmt::format("line {}", number), problem,
          "cut polygons into triangles where they were made, or " + raise_remedy(Limit::POLYGON_CORNERS));
    };
    if (in_face && corners > most_corners)
      fail(fmt::format("a polygon of {} corners or more, above the limit of {}", corners, most_corners));
    if (length > BYTES_PER_CORNER * most_corners)
      fail(fmt::format("a line of {} bytes, more than a polygon of {} corners needs", length, most_corners));
    const bool continues = line.ends_with('\\') || line.ends_with("\\\r");
    if (!continues) length = 0;
  }
}

std::string without_materials(std::string_view text) {
  std::string result(text);
  for (std::size_t begin = 0; begin < result.size();) {
    const std::size_t end = std::min(result.find('\n', begin), result.size());
    const std::size_t word = result.find_first_not_of(" \t", begin);
    const std::string_view line = std::string_view(result).substr(begin, end - begin);
    if (word < end) {
      const std::string_view rest = line.substr(word - begin);
      // A comment that ends in a backslash must not swallow the next line.
      if (rest.starts_with("mtllib") || rest.starts_with("usemtl"))
        std::fill(result.begin() + static_cast<std::ptrdiff_t>(word),
                  result.begin() + static_cast<std::ptrdiff_t>(end), '#');
    }
    begin = end + 1;
  }
  return result;
}

}  // namespace lmdbench
