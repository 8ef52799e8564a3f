// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/base/input_file.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/cut_short.h>
#include <lmdbench/catalogue/off_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace lmdbench {

namespace {

/// Within a line of an OFF file.
constexpr std::string_view OFF_BLANKS = " \t\r";

// Positions come first in a vertex's line whatever follows: texture coordinates (ST), colours (C), normals (N).
constexpr std::array<std::string_view, 8> KEYWORDS{"OFF",   "COFF",   "NOFF",   "CNOFF",
                                                   "STOFF", "STCOFF", "STNOFF", "STCNOFF"};

// Hands out the file's lines without comments and blank lines, and numbers from them.
class LineReader {
 public:
  LineReader(std::string file, std::string_view text) : file_(std::move(file)), rest_(text) {}

  // Goes to the next line that holds something.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      line_ = rest_.substr(0, end);
      rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
      ++line_number_;
      line_ = line_.substr(0, line_.find('#'));
      skip_blanks();
      if (!line_.empty()) return true;
    }
    return false;
  }

  std::string_view word() {
    const std::string_view result = line_.substr(0, line_.find_first_of(OFF_BLANKS));
    line_.remove_prefix(result.size());
    skip_blanks();
    return result;
  }

  template <typename Number>
  Number number(const char* what) {
    std::string_view text = word();
    if (text.empty()) fail(fmt::format("{} is missing", what));
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) fail(fmt::format("{} '{}' is out of range", what, text));
    if (error != std::errc{} || end != text.data() + text.size())
      fail(fmt::format("{} '{}' is not a number", what, text));
    return value;
  }

  bool begins_with(std::string_view start) const { return line_.starts_with(start); }
  bool at_line_end() const { return line_.empty(); }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy = "correct the line") const {
    throw InputError(file_, fmt::format("line {}", line_number_), problem, remedy);
  }

 private:
  void skip_blanks() { line_.remove_prefix(std::min(line_.size(), line_.find_first_not_of(OFF_BLANKS))); }

  std::string file_;
  std::string_view rest_, line_;
  std::size_t line_number_ = 0;
};

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
  for (std::int64_t f = 0; f < count; ++f) {
    if (!lines.next_line())
      lines.fail(fmt::format("the file ends after {} of {} faces", f, count), CUT_SHORT);
    const auto corner_count = lines.number<std::int64_t>("a face's number of corners");
    if (corner_count < 1) lines.fail(fmt::format("face {} has {} corners", f, corner_count));
    if (corner_count > limit_of(Limit::POLYGON_CORNERS))
      lines.fail(fmt::format("face {} is a polygon of {} corners, above the limit of {}", f, corner_count,
                             limit_of(Limit::POLYGON_CORNERS)),
                 "cut it into triangles where it was made, or " + raise_remedy(Limit::POLYGON_CORNERS));
    std::array<std::int32_t, 3> fan{};
    for (std::int64_t k = 0; k < corner_count; ++k) {
      const auto corner = lines.number<std::int64_t>("a vertex index");
      if (corner < 0 || corner >= vertex_count)
        lines.fail(fmt::format("face {} names vertex {}, but there are {} vertices", f, corner, vertex_count),
                   "vertices are counted from 0; correct the index");
      fan[static_cast<std::size_t>(std::min<std::int64_t>(k, 2))] = static_cast<std::int32_t>(corner);
      if (k < 2) continue;
      mesh.triangles.push_back(fan);
      if (static_cast<std::int64_t>(mesh.triangles.size()) > limit_of(Limit::TRIANGLES))
        lines.fail(fmt::format("more triangles than the limit of {}", limit_of(Limit::TRIANGLES)),
                   "decimate the mesh, or " + raise_remedy(Limit::TRIANGLES));
      fan[1] = fan[2];
    }
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
  // The counts stand on the keyword's line or the next.
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
