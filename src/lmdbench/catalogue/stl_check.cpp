// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/catalogue/line_reader.h>
#include <lmdbench/catalogue/stl_check.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/endian/conversion.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace lmdbench {
namespace {

constexpr std::size_t HEADER_BYTES = 84, TRIANGLE_BYTES = 50;

std::string lower(std::string_view text) {
  return boost::algorithm::to_lower_copy(std::string(text));
}

void check_vertices(std::string_view text, const std::string& file) {
  LineReader lines(file, text);
  while (lines.next_line()) {
    std::string_view word = lines.word();
    if (word == "solid" || word == "endsolid") continue;  // a name follows
    while (!word.empty()) {
      const bool is_vertex = word == "vertex";
      for (int axis = 0; is_vertex && axis < 3; ++axis) lines.number<double>("a coordinate");
      word = lines.word();
      if (is_vertex && !word.empty() && word != "vertex" && word != "endloop")
        lines.fail(fmt::format("a vertex goes on with '{}' behind its three coordinates", word));
    }
  }
}

}  // namespace

std::string checked_stl(std::string_view bytes, const std::string& file) {
  std::size_t announced = 0, whole = 0;
  if (bytes.size() >= HEADER_BYTES) {
    announced = boost::endian::load_little_u32(reinterpret_cast<const unsigned char*>(bytes.data()) +
                                               HEADER_BYTES - 4);
    whole = HEADER_BYTES + TRIANGLE_BYTES * announced;
    if (bytes.size() == whole) return std::string(bytes);
  }
  // Binary headers may begin with "solid", too.
  const std::string_view unmarked = without_byte_order_mark(bytes);
  const std::string start = lower(unmarked.substr(0, 1024));
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  const bool is_text = first != std::string::npos && start.compare(first, 5, "solid") == 0 &&
                       (start.find("facet") != std::string::npos ||
                        start.find("endsolid") != std::string::npos || bytes.size() < HEADER_BYTES);
  if (is_text) {
    std::string text = lower(unmarked);
    const std::size_t end = text.rfind("endsolid"), corner = text.rfind("vertex");
    if (end == std::string::npos || (corner != std::string::npos && corner > end))
      throw InputError(file, "", "ends without 'endsolid'",
                       "the file may be cut short: get it again, or add the line");
    check_vertices(text, file);
    // assimp takes text with other bytes in a name for none.
    std::ranges::replace_if(
        text, [](unsigned char c) { return c > 126; }, '_');
    return text.substr(first);
  }
  if (whole == 0)
    throw InputError(file, "", "is neither text that begins with 'solid' nor as long as binary STL",
                     "get it again, or export it as binary STL");
  throw InputError(file, "",
                   fmt::format("holds {} bytes, but a binary STL file of the {} triangles that its header "
                               "announces has {}",
                               bytes.size(), announced, whole),
                   bytes.size() < whole ? CUT_SHORT : TOO_LONG);
}

}  // namespace lmdbench
