// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/line_reader.h>
#include <lmdbench/catalogue/ply_file.h>
#include <lmdbench/catalogue/polygon.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench {
namespace {

/// Separators of words in a header.
constexpr std::string_view PLY_BLANKS = " \t\r\n\v\f";

struct ScalarType {
  std::string_view name;
  std::size_t bytes;
  bool is_integer;
  bool is_signed;
};

constexpr std::array<ScalarType, 16> SCALAR_TYPES{{{"char", 1, true, true},
                                                   {"int8", 1, true, true},
                                                   {"uchar", 1, true, false},
                                                   {"uint8", 1, true, false},
                                                   {"short", 2, true, true},
                                                   {"int16", 2, true, true},
                                                   {"ushort", 2, true, false},
                                                   {"uint16", 2, true, false},
                                                   {"int", 4, true, true},
                                                   {"int32", 4, true, true},
                                                   {"uint", 4, true, false},
                                                   {"uint32", 4, true, false},
                                                   {"float", 4, false, true},
                                                   {"float32", 4, false, true},
                                                   {"double", 8, false, true},
                                                   {"float64", 8, false, true}}};

struct Property {
  std::string name;
  ScalarType type;                  ///< Of a list: of its items.
  std::optional<ScalarType> count;  ///< Of a list: of its length.
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

enum class Form : std::uint8_t { TEXT, LITTLE_ENDIAN_BINARY, BIG_ENDIAN_BINARY };

std::string_view next_word(std::string_view& text) {
  text.remove_prefix(std::min(text.size(), text.find_first_not_of(PLY_BLANKS)));
  const std::string_view word = text.substr(0, text.find_first_of(PLY_BLANKS));
  text.remove_prefix(word.size());
  return word;
}

std::optional<std::int64_t> whole_number(std::string_view word) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// The header, line by line.
class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& file) : rest_(bytes), file_(file) {}

  std::vector<Element> read() {
    if (next_line() != "ply") fail("does not begin with 'ply'");
    for (;;) {
      std::string_view line = next_line();
      const std::string_view keyword = next_word(line);
      if (keyword == "end_header") break;
      if (keyword == "format") {
        if (form_) fail("a second format", "keep one of them");
        form_ = form_of(next_word(line));
        if (next_word(line) != "1.0") fail("the format is not of version 1.0", "export it as such");
      } else if (keyword == "element") {
        add_element(line);
      } else if (keyword == "property") {
        add_property(line);
      } else if (keyword != "comment" && keyword != "obj_info") {
        fail(fmt::format("'{}' is no keyword of a header", keyword));
      }
    }
    if (!form_) fail("the header names no format");
    refuse_flat_vertices();
    return std::move(elements_);
  }
  Form form() const { return *form_; }
  std::size_t lines() const { return line_number_; }
  std::string_view body() const { return rest_; }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy = "correct the header") const {
    throw InputError(file_, fmt::format("line {}", line_number_), problem, remedy);
  }

  void refuse_flat_vertices() const {
    for (const Element& element : elements_)
      for (const char* name : {"x", "y", "z"}) {
        const auto found = std::ranges::find(element.properties, name, &Property::name);
        if (element.name == "vertex" && (found == element.properties.end() || found->count ||
                                         std::ranges::count(element.properties, name, &Property::name) > 1))
          fail(fmt::format("element 'vertex' has no property {} that is one number", name),
               "export the mesh with x, y and z");
      }
  }

  std::string_view next_line() {
    ++line_number_;
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos)
      fail("the header ends without 'end_header'", "the file may be cut short: get it again");
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    while (!line.empty() && PLY_BLANKS.find(line.back()) != std::string_view::npos) line.remove_suffix(1);
    return line;
  }

  Form form_of(std::string_view word) const {
    if (word == "ascii") return Form::TEXT;
    if (word == "binary_little_endian") return Form::LITTLE_ENDIAN_BINARY;
    if (word == "binary_big_endian") return Form::BIG_ENDIAN_BINARY;
    fail(fmt::format("'{}' is no format", word), "use ascii, binary_little_endian or binary_big_endian");
  }

  ScalarType type_of(std::string_view word) const {
    const auto* const found = std::find_if(SCALAR_TYPES.begin(), SCALAR_TYPES.end(),
                                           [&](const ScalarType& type) { return type.name == word; });
    if (found == SCALAR_TYPES.end())
      fail(fmt::format("'{}' is no type of a property", word), "use float, double, uchar, int, ...");
    return *found;
  }

  void add_element(std::string_view line) {
    Element element;
    element.name = next_word(line);
    const std::optional<std::int64_t> count = whole_number(next_word(line));
    if (!count || *count < 0) fail(fmt::format("element '{}' has no count of at least 0", element.name));
    element.count = *count;
    if (element.name == "face" && element.count > limit_of(Limit::TRIANGLES))
      fail(
          fmt::format("announces {} faces, above the limit of {}", element.count, limit_of(Limit::TRIANGLES)),
          "decimate the mesh, or " + raise_remedy(Limit::TRIANGLES));
    elements_.push_back(std::move(element));
  }

  void add_property(std::string_view line) {
    if (elements_.empty()) fail("a property stands before the first element");
    Property property;
    std::string_view word = next_word(line);
    if (word == "list") {
      property.count = type_of(next_word(line));
      if (!property.count->is_integer) fail("the length of a list is no whole number");
      word = next_word(line);
    }
    property.type = type_of(word);
    property.name = next_word(line);
    if (property.name.empty()) fail("a property has no name");
    elements_.back().properties.push_back(property);
  }

  std::string_view rest_;
  std::string file_;
  std::size_t line_number_ = 0;
  std::optional<Form> form_;
  std::vector<Element> elements_;
};

/// Reads the content after the header.
class BodyReader {
 public:
  BodyReader(const HeaderReader& header, const std::string& file)
      : rest_(header.body()), lines_before_(header.lines()), form_(header.form()), file_(file) {
    if (form_ != Form::TEXT) return;
    if (const std::size_t mark = rest_.find('#'); mark != std::string_view::npos)
      throw InputError(
          file_, fmt::format("line {}", lines_before_ + 1 + std::ranges::count(rest_.substr(0, mark), '\n')),
          "'#' begins no comment in a PLY file", "remove it");
    text_.emplace(file_, rest_, lines_before_);
  }

  /// Adds the vertices to a mesh that has none, or its triangles to one that has its vertices:
  /// faces may stand before vertices.
  void read(const std::vector<Element>& elements, TriangleMesh& mesh) {
    const bool vertices_are_read = !mesh.vertices.empty();
    for (const Element& element : elements) {
      if (element.properties.empty() && element.count > 0)
        throw InputError(file_, "element " + element.name, "has no properties", "correct the header");
      for (std::int64_t i = 0; i < element.count; ++i) {
        if (text_ && !text_->next_line()) fail(element, i, ENDS_BEFORE);
        if (element.name == "vertex" && !vertices_are_read)
          mesh.vertices.push_back(read_vertex(element, i));
        else if (vertices_are_read && (element.name == "face" || element.name == "tristrips"))
          read_corners(element, i, mesh);
        else
          for (const Property& property : element.properties)
            read_property(property, element, i, [](double) {});
        if (text_ && !text_->at_line_end())
          text_->fail(
              fmt::format("{} {} goes on behind its {}", element.name, i, element.properties.back().name),
              "write an element a line, with the numbers that the header announces");
      }
    }
    if (text_ ? text_->next_line() : !rest_.empty())
      throw InputError(file_, "", "goes on behind what its header announces", TOO_LONG);
  }

 private:
  static constexpr const char* ENDS_BEFORE = "is not there: the file ends before";
  static constexpr const char* COUNTED = "vertices are counted from 0; correct the index";

  Vec3 read_vertex(const Element& element, std::int64_t index) {
    Vec3 vertex = Vec3::Zero();
    for (const Property& property : element.properties)
      read_property(property, element, index, [&](double value) {
        if (property.name == "x") vertex.x() = value;
        if (property.name == "y") vertex.y() = value;
        if (property.name == "z") vertex.z() = value;
      });
    return vertex;
  }

  void read_corners(const Element& element, std::int64_t index, TriangleMesh& mesh) {
    const bool is_strip = element.name == "tristrips";
    corners_.clear();
    bool has_list = false;
    for (const Property& property : element.properties) {
      const bool has_corners =
          property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
      if (has_corners && has_list) fail(element, index, "has two lists of corners", "keep one of them");
      has_list = has_list || has_corners;
      read_property(property, element, index, [&](double value) {
        if (!has_corners) return;
        if (value != std::floor(value)) fail(element, index, fmt::format("names vertex {}", value), COUNTED);
        if (!(value >= 0.0 && value < static_cast<double>(mesh.vertices.size())) &&
            !(is_strip && value == -1.0))
          fail(element, index,
               fmt::format("names vertex {}, but there are {} vertices", value, mesh.vertices.size()),
               COUNTED);
        corners_.push_back(static_cast<std::int32_t>(value));
      });
    }
    if (!has_list)
      fail(element, index, "has no list 'vertex_indices' or 'vertex_index'", "name the list of corners so");
    for (const std::int32_t corner : corners_)
      if (corner >= 0 && !mesh.vertices[static_cast<std::size_t>(corner)].allFinite())
        throw InputError(file_, fmt::format("vertex {}", corner), "has a coordinate that is not finite",
                         "correct or remove it");
    if (is_strip) return add_strips(mesh);
    if (corners_.size() < 3) return;
    if (const std::optional<PolygonFault> fault = add_polygon(corners_, mesh))
      fail(element, index, fault->problem, fault->remedy);
  }

  /// Strips, parted by -1; every second triangle of one turns the other way.
  void add_strips(TriangleMesh& mesh) const {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] < 0) begin = i + 1;
      if (i < begin + 2) continue;
      std::array<std::int32_t, 3> triangle{corners_[i - 2], corners_[i - 1], corners_[i]};
      if ((i - begin) % 2 == 1) std::swap(triangle[0], triangle[1]);
      mesh.triangles.push_back(triangle);
    }
  }

  /// @param take  is called with each number
  void read_property(const Property& property, const Element& element, std::int64_t index, const auto& take) {
    std::int64_t items = 1;
    if (property.count) {
      const std::optional<double> length = read_number(*property.count, "the length of a list");
      if (!length || !(*length >= 0.0 && *length < 0x1p32))
        fail(element, index, "has no whole number for the length of its list");
      items = static_cast<std::int64_t>(*length);
      if (!text_ && static_cast<std::uint64_t>(items) > rest_.size() / property.type.bytes)
        fail(element, index, ENDS_BEFORE);
    }
    for (; items > 0; --items) {
      const std::optional<double> value = read_number(property.type, property.name.c_str());
      if (!value) fail(element, index, ENDS_BEFORE);
      take(*value);
    }
  }

  /// Nothing at the end of a binary file. Coordinates have the precision that the header names.
  std::optional<double> read_number(const ScalarType& type, const char* what) {
    if (text_) {
      if (type.is_integer) return static_cast<double>(text_->number<std::int64_t>(what));
      return type.bytes == 4 ? text_->single(what) : text_->number<double>(what);
    }
    if (rest_.size() < type.bytes) return std::nullopt;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
      const std::size_t at = form_ == Form::BIG_ENDIAN_BINARY ? i : type.bytes - 1 - i;
      bits = (bits << 8U) | static_cast<unsigned char>(rest_[at]);
    }
    rest_.remove_prefix(type.bytes);
    if (!type.is_integer)
      return type.bytes == 8 ? std::bit_cast<double>(bits)
                             : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.bytes - 1);
    if (!type.is_signed || (bits & sign) == 0) return static_cast<double>(bits);
    return static_cast<double>(static_cast<std::int64_t>(bits)) - 2.0 * static_cast<double>(sign);
  }

  [[noreturn]] void fail(const Element& element, std::int64_t index, const std::string& problem,
                         const std::string& remedy = CUT_SHORT) const {
    throw InputError(file_, fmt::format("{} {} of {}", element.name, index, element.count), problem, remedy);
  }

  std::string_view rest_;
  std::size_t lines_before_;
  Form form_;
  std::string file_;
  std::optional<LineReader> text_;
  std::vector<std::int32_t> corners_;
};

}  // namespace

TriangleMesh parse_ply(std::string_view bytes, const std::string& file) {
  HeaderReader header(bytes, file);
  const std::vector<Element> elements = header.read();
  TriangleMesh mesh;
  BodyReader(header, file).read(elements, mesh);
  if (!mesh.vertices.empty()) BodyReader(header, file).read(elements, mesh);
  return mesh;
}

}  // namespace lmdbench
