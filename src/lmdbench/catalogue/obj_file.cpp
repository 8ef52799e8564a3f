// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/catalogue/line_reader.h>
#include <lmdbench/catalogue/obj_file.h>
#include <lmdbench/catalogue/polygon_fan.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

namespace lmdbench {
namespace {

/// Keywords of skipped lines.
constexpr std::array<std::string_view, 11> LEFT_OUT{"vn", "vt", "vp",     "g",      "o", "s",
                                                    "l",  "p",  "mtllib", "usemtl", "mg"};

Vec3 read_position(LineReader& lines) {
  Vec3 position;
  for (int axis = 0; axis < 3; ++axis)
    position[axis] = static_cast<double>(static_cast<float>(lines.number<double>("a coordinate")));
  if (!lines.at_line_end()) {
    const double weight = lines.number<double>("a weight or colour");
    if (lines.at_line_end()) position /= weight;  // else it is the first part of a colour
  }
  if (!position.allFinite()) lines.fail("a coordinate is not finite", "correct or remove it");
  return position;
}

/// The position that "7", "7/1", "7//3" or "-1" (the last one so far) refers to.
const Vec3& read_corner(const LineReader& lines, std::string_view word, const std::vector<Vec3>& positions) {
  const auto count = static_cast<std::int64_t>(positions.size());
  const auto named = lines.number<std::int64_t>("a vertex index", word.substr(0, word.find('/')));
  const std::int64_t index = named < 0 ? count + named : named - 1;
  if (index < 0 || index >= count)
    lines.fail(fmt::format("a face names vertex {}, but {} vertices stand before it", named, count),
               "vertices are counted from 1, backwards from -1; correct the index");
  return positions[static_cast<std::size_t>(index)];
}

}  // namespace

TriangleMesh parse_obj(std::string_view text, const std::string& file) {
  LineReader lines(file, text);
  TriangleMesh mesh;
  std::vector<Vec3> positions, corners;
  std::vector<std::int32_t> polygon;
  while (lines.next_line()) {
    if (lines.ends_with("\\") || lines.ends_with("\\\r"))
      lines.fail("the line is continued on the next", "join the two lines");
    const std::string_view keyword = lines.word();
    if (keyword == "v") {
      positions.push_back(read_position(lines));
      continue;
    }
    if (keyword != "f") {
      if (std::find(LEFT_OUT.begin(), LEFT_OUT.end(), keyword) == LEFT_OUT.end())
        lines.fail(fmt::format("'{}' is no keyword of a polygon mesh", keyword.substr(0, 40)),
                   "convert the file to OFF");
      continue;
    }
    corners.clear();
    while (!lines.at_line_end()) corners.push_back(read_corner(lines, lines.word(), positions));
    if (corners.size() < 3) lines.fail(fmt::format("a face of {} corners", corners.size()));
    // Every face has its own corners, as in assimp: import welds them in the order of use.
    polygon.resize(corners.size());
    std::iota(polygon.begin(), polygon.end(), static_cast<std::int32_t>(mesh.vertices.size()));
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    add_polygon(polygon, lines, mesh);
  }
  return mesh;
}

}  // namespace lmdbench
