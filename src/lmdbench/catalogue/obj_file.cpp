// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/line_reader.h>
#include <lmdbench/catalogue/obj_file.h>
#include <lmdbench/catalogue/polygon.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lmdbench {
namespace {

/// Keywords of curves and surfaces that are no polygons.
constexpr std::array<std::string_view, 18> FREE_FORM{"cstype", "deg",  "bmat", "step", "curv", "curv2",
                                                     "surf",   "parm", "trim", "hole", "scrv", "sp",
                                                     "con",    "call", "bzp",  "bsp",  "cdc",  "cdp"};

/// Calls back for each vertex ("v") or face ("f"), with a reader behind the keyword. Lines that a
/// backslash continues are joined.
void for_each_line(std::string_view text, const std::string& file, const auto& take) {
  LineReader lines(file, text);
  const auto continues = [&] { return lines.ends_with("\\") || lines.ends_with("\\\r"); };
  std::string joined;
  while (lines.next_line()) {
    const bool goes_on = continues();
    std::string_view word = lines.word();
    if (word.ends_with('\\')) word.remove_suffix(1);
    if (word == "fo" || word == "F") word = "f";  // of old and of careless writers
    if (word == "V") word = "v";
    if (std::ranges::any_of(word, [](unsigned char c) { return c < ' '; }))
      lines.fail("a keyword has a control character", "remove it, or get the file again");
    if (std::ranges::find(FREE_FORM, word) != FREE_FORM.end())
      lines.fail(fmt::format("'{}' is part of a free-form curve or surface", word),
                 "export the mesh as polygons");
    if (word != "v" && word != "f") continue;
    if (!goes_on) {
      take(word, lines);
      continue;
    }
    joined.clear();
    do {
      joined.append(lines.rest().substr(0, lines.rest().rfind('\\'))).append(" ");
      if (!lines.next_line()) lines.fail("the file ends in a line that goes on", CUT_SHORT);
    } while (continues());
    joined.append(lines.rest());
    LineReader line(file, joined, lines.line_number() - 1);
    if (!line.next_line()) line.fail("nothing behind its keyword");
    take(word, line);
  }
}

Vec3 read_position(LineReader& line) {
  Vec3 position = Vec3::Zero();
  int numbers = 0;
  for (; numbers < 3 || !line.at_line_end(); ++numbers) {
    const double number = line.single("a coordinate");
    if (numbers < 3) position[numbers] = number;
  }
  // A weight or a colour may follow.
  if (numbers != 3 && numbers != 4 && numbers != 6) line.fail(fmt::format("a vertex of {} numbers", numbers));
  return position;
}

/// The vertex that "7", "7/1", "7//3" or "-1" (the last one so far) names.
std::int32_t read_corner(LineReader& line, std::int64_t before, const std::vector<Vec3>& vertices) {
  constexpr const char* COUNTED = "vertices are counted from 1, backwards from -1; correct the index";
  const std::string_view word = line.word();
  const auto named = line.number<std::int64_t>("a vertex index", word.substr(0, word.find('/')));
  if (named == 0 || named < -before)
    line.fail(fmt::format("a face names vertex {}, but {} vertices stand before it", named, before), COUNTED);
  if (named > std::ssize(vertices))  // it may come later
    line.fail(fmt::format("a face names vertex {}, but the file has {}", named, vertices.size()), COUNTED);
  const std::int64_t index = named < 0 ? before + named : named - 1;
  if (!vertices[static_cast<std::size_t>(index)].allFinite())
    line.fail(fmt::format("vertex {} has a coordinate that is not finite", index + 1),
              "correct or remove it");
  return static_cast<std::int32_t>(index);
}

}  // namespace

TriangleMesh parse_obj(std::string_view text, const std::string& file) {
  TriangleMesh mesh;
  for_each_line(text, file, [&](std::string_view keyword, LineReader& line) {
    if (keyword == "v") mesh.vertices.push_back(read_position(line));
  });
  std::int64_t before = 0;
  std::vector<std::int32_t> corners;
  for_each_line(text, file, [&](std::string_view keyword, LineReader& line) {
    if (keyword == "v") {
      ++before;
      return;
    }
    corners.clear();
    while (!line.at_line_end()) corners.push_back(read_corner(line, before, mesh.vertices));
    if (corners.size() < 3) line.fail(fmt::format("a face of {} corners", corners.size()), CUT_SHORT);
    if (const std::optional<PolygonFault> fault = add_polygon(corners, mesh))
      line.fail(fault->problem, fault->remedy);
  });
  return mesh;
}

}  // namespace lmdbench
