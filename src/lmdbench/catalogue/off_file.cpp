// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/catalogue/line_reader.h>
#include <lmdbench/catalogue/off_file.h>
#include <lmdbench/catalogue/polygon.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

namespace {

// Positions come first in every form; texture coordinates (ST), colours (C), normals (N) follow.
constexpr std::array<std::string_view, 8> KEYWORDS{"OFF",   "COFF",   "NOFF",   "CNOFF",
                                                   "STOFF", "STCOFF", "STNOFF", "STCNOFF"};

void read_vertices(LineReader& lines, std::int64_t count, TriangleMesh& mesh) {
  for (std::int64_t v = 0; v < count; ++v) {
    if (!lines.next_line())
      lines.fail(fmt::format("the file ends after {} of {} vertices", v, count), CUT_SHORT);
    Vec3 vertex;
    for (int axis = 0; axis < 3; ++axis) vertex[axis] = lines.number<double>("a coordinate");
    if (!vertex.allFinite())
      lines.fail(fmt::format("vertex {} has a coordinate that is not finite", v), "correct or remove it");
    mesh.vertices.push_back(vertex);
  }
}

void read_faces(LineReader& lines, std::int64_t count, TriangleMesh& mesh) {
  const auto vertex_count = static_cast<std::int64_t>(mesh.vertices.size());
  std::vector<std::int32_t> corners;
  for (std::int64_t f = 0; f < count; ++f) {
    if (!lines.next_line())
      lines.fail(fmt::format("the file ends after {} of {} faces", f, count), CUT_SHORT);
    const auto corner_count = lines.number<std::int64_t>("a face's number of corners");
    if (corner_count < 1) lines.fail(fmt::format("face {} has {} corners", f, corner_count));
    corners.clear();
    for (std::int64_t k = 0; k < corner_count; ++k) {
      const auto corner = lines.number<std::int64_t>("a vertex index");
      if (corner < 0 || corner >= vertex_count)
        lines.fail(fmt::format("face {} names vertex {}, but there are {} vertices", f, corner, vertex_count),
                   "vertices are counted from 0; correct the index");
      corners.push_back(static_cast<std::int32_t>(corner));
    }
    if (corner_count < 3) continue;
    if (const std::optional<PolygonFault> fault = add_polygon(corners, mesh))
      lines.fail(fault->problem, fault->remedy);
  }
}

}  // namespace

TriangleMesh parse_off(std::string_view text, const std::string& file) {
  LineReader lines(file, text);
  if (!lines.next_line()) throw InputError(file, "", "is empty", "check that it is the right file");
  const std::string_view keyword = lines.word();
  if (std::find(KEYWORDS.begin(), KEYWORDS.end(), keyword) == KEYWORDS.end())
    lines.fail(fmt::format("'{}' is no keyword of an OFF file in three dimensions", keyword.substr(0, 40)),
               "begin the file with OFF (COFF, NOFF, STOFF and their mixtures are read, too)");
  // The counts are on the keyword's line or the next.
  if (lines.at_line_end() && !lines.next_line())
    lines.fail("the file ends after its keyword", "get the file again: it may be cut short");
  if (lines.begins_with("BINARY"))
    lines.fail("binary OFF is not read", "convert it to OFF text, PLY, OBJ or STL");
  const auto vertex_count = lines.number<std::int64_t>("the number of vertices");
  const auto face_count = lines.number<std::int64_t>("the number of faces");
  if (vertex_count < 0 || face_count < 0 || vertex_count > std::numeric_limits<std::int32_t>::max())
    lines.fail("the header's counts are negative or too large", "correct the header");
  TriangleMesh mesh;
  read_vertices(lines, vertex_count, mesh);
  read_faces(lines, face_count, mesh);
  if (lines.next_line())
    lines.fail("the file goes on behind what its header announces", "correct the header's counts");
  return mesh;
}

TriangleMesh read_off(const std::filesystem::path& file) {
  return parse_off(read_input_file(file, {.what = "mesh file"}).bytes, file.string());
}

std::string to_off_text(const TriangleMesh& mesh) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& vertex : mesh.vertices)
    fmt::format_to(out, "{} {} {}\n", vertex.x(), vertex.y(), vertex.z());
  for (const auto& [a, b, c] : mesh.triangles) fmt::format_to(out, "3 {} {} {}\n", a, b, c);
  return fmt::to_string(text);
}

void write_off(const std::filesystem::path& file, const TriangleMesh& mesh) {
  write_file_atomically(file, to_off_text(mesh));
}

}  // namespace lmdbench
