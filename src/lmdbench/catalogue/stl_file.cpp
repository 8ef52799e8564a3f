// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/catalogue/line_reader.h>
#include <lmdbench/catalogue/stl_file.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/endian/conversion.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace lmdbench {
namespace {

constexpr std::string_view FACET = "facet normal ", DIGITS = "-+.0123456789";
constexpr std::size_t HEADER_BYTES = 84, TRIANGLE_BYTES = 50;

std::string lower(std::string_view text) {
  return boost::algorithm::to_lower_copy(std::string(text));
}

void add_triangle(const std::array<Vec3, 3>& corners, TriangleMesh& mesh) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

TriangleMesh parse_text(std::string_view text, const std::string& file) {
  LineReader lines(file, text);
  TriangleMesh mesh;
  std::array<Vec3, 3> corners;
  std::size_t count = 0;
  bool is_open = true;
  while (lines.next_line()) {
    std::string_view word = lines.word();
    if (word == "solid" || word == "endsolid") {  // a name follows
      is_open = word == "solid";
      const std::size_t facet = lines.rest().find(FACET);
      if (facet != std::string_view::npos &&
          lines.rest().find_first_of(DIGITS, facet) == facet + FACET.size())
        lines.fail("a facet stands on the line of a solid's name", "begin it on a line of its own");
      continue;
    }
    while (!word.empty()) {
      const bool is_vertex = word == "vertex";
      if (is_vertex && !is_open) lines.fail("a vertex behind 'endsolid'", "begin another solid before it");
      if (is_vertex && count == 3) lines.fail("a facet of more than three vertices");
      for (int axis = 0; is_vertex && axis < 3; ++axis) corners[count][axis] = lines.single("a coordinate");
      if (is_vertex && !corners[count].allFinite())
        lines.fail("a coordinate is not finite", "correct or remove it");
      if (is_vertex) ++count;
      if (word == "endfacet") {
        if (count != 3) lines.fail(fmt::format("a facet of {} vertices", count));
        add_triangle(corners, mesh);
        count = 0;
      }
      word = lines.word();
      if (is_vertex && !word.empty() && word != "vertex" && word != "endloop")
        lines.fail(fmt::format("a vertex goes on with '{}' behind its three coordinates", word));
    }
  }
  if (is_open)
    throw InputError(file, "", "ends without 'endsolid'",
                     "the file may be cut short: get it again, or add the line");
  if (count != 0) lines.fail("the last facet has no 'endfacet'", CUT_SHORT);
  return mesh;
}

/// @param bytes of as many triangles as the header says
TriangleMesh parse_binary(std::string_view bytes, const std::string& file) {
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  TriangleMesh mesh;
  for (std::size_t at = HEADER_BYTES; at < bytes.size(); at += TRIANGLE_BYTES) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 9; ++k)  // behind the normal
      corners[k / 3][static_cast<Eigen::Index>(k % 3)] =
          static_cast<double>(std::bit_cast<float>(boost::endian::load_little_u32(data + at + 12 + 4 * k)));
    for (const Vec3& corner : corners)
      if (!corner.allFinite())
        throw InputError(file, fmt::format("facet {}", mesh.triangles.size()),
                         "has a coordinate that is not finite", "correct or remove it");
    add_triangle(corners, mesh);
  }
  return mesh;
}

}  // namespace

TriangleMesh parse_stl(std::string_view bytes, const std::string& file) {
  std::size_t announced = 0, whole = 0;
  if (bytes.size() >= HEADER_BYTES) {
    announced = boost::endian::load_little_u32(reinterpret_cast<const unsigned char*>(bytes.data()) +
                                               HEADER_BYTES - 4);
    whole = HEADER_BYTES + TRIANGLE_BYTES * announced;
    if (bytes.size() == whole) return parse_binary(bytes, file);
  }
  // Binary headers may begin with "solid", too.
  const std::string_view unmarked = without_byte_order_mark(bytes);
  const std::string start = lower(unmarked.substr(0, 1024));
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  const bool is_text =
      first != std::string::npos && start.compare(first, 5, "solid") == 0 &&
      (start.find("facet") != std::string::npos || start.find("endsolid") != std::string::npos ||
       bytes.size() < HEADER_BYTES || unmarked.find('\0') == std::string_view::npos);
  if (is_text) return parse_text(lower(unmarked), file);
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
