// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/line_reader.h>
#include <lmdbench/catalogue/obj_file.h>
#include <lmdbench/catalogue/polygon_fan.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace lmdbench {
namespace {

/// Keywords of skipped lines.
constexpr std::array<std::string_view, 11> LEFT_OUT{"vn", "vt", "vp",     "g",      "o", "s",
                                                    "l",  "p",  "mtllib", "usemtl", "mg"};

constexpr const char* CONVERT =
    "cut polygons into triangles where they were made, or convert the file to OFF";

Vec3 read_position(LineReader& lines) {
  Vec3 position;
  for (int axis = 0; axis < 3; ++axis)
    position[axis] = static_cast<double>(static_cast<float>(lines.number<double>("a coordinate")));
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
    const std::optional<std::size_t> first_corner = fan_corner(corners);
    if (!first_corner) lines.fail("a polygon that no fan of triangles fills", CONVERT);
    std::ranges::rotate(corners, corners.begin() + static_cast<std::ptrdiff_t>(*first_corner));
    // Every face has its own corners, as in assimp: import welds them in the order of use.
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    for (std::int32_t k = 1; k + 1 < static_cast<std::int32_t>(corners.size()); ++k)
      mesh.triangles.push_back({first, first + k, first + k + 1});
    if (static_cast<std::int64_t>(mesh.triangles.size()) > limit_of(Limit::TRIANGLES))
      lines.fail(fmt::format("more triangles than the limit of {}", limit_of(Limit::TRIANGLES)),
                 "decimate the mesh, or " + raise_remedy(Limit::TRIANGLES));
  }
  return mesh;
}

}  // namespace lmdbench
