// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/catalogue/line_reader.h>
#include <lmdbench/catalogue/ply_check.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
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
  bool is_polygon = false;          ///< The list of a face's corners.
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
        form_ = form_of(next_word(line));
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
      for (const char* name : {"x", "y", "z"})
        if (element.name == "vertex" &&
            std::ranges::find(element.properties, name, &Property::name) == element.properties.end())
          fail(fmt::format("element 'vertex' has no property {}", name), "export the mesh with x, y and z");
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
    property.is_polygon =
        property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
    elements_.back().properties.push_back(property);
  }

  std::string_view rest_;
  std::string file_;
  std::size_t line_number_ = 0;
  std::optional<Form> form_;
  std::vector<Element> elements_;
};

/// Walks over the content after the header.
class BodyWalk {
 public:
  BodyWalk(const HeaderReader& header, const std::string& file)
      : rest_(header.body()), lines_before_(header.lines()), form_(header.form()), file_(file) {}

  void walk(const std::vector<Element>& elements) {
    if (form_ == Form::TEXT) {
      if (const std::size_t mark = rest_.find('#'); mark != std::string_view::npos)
        throw InputError(
            file_,
            fmt::format("line {}", lines_before_ + 1 + std::ranges::count(rest_.substr(0, mark), '\n')),
            "'#' begins no comment in a PLY file", "remove it");
      text_.emplace(file_, rest_, lines_before_);
    }
    for (const Element& element : elements) {
      if (element.properties.empty() && element.count > 0)
        throw InputError(file_, "element " + element.name, "has no properties", "correct the header");
      for (std::int64_t i = 0; i < element.count; ++i) {
        if (text_ && !text_->next_line()) fail(element, i, ENDS_BEFORE);
        for (const Property& property : element.properties) skip(property, element, i);
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

  void skip(const Property& property, const Element& element, std::int64_t index) {
    std::int64_t items = 1;
    if (property.count) {
      const std::optional<std::int64_t> length = read_whole_number(*property.count);
      if (!length || *length < 0) fail(element, index, "has no whole number for the length of its list");
      items = *length;
      if (property.is_polygon && items > limit_of(Limit::POLYGON_CORNERS))
        throw InputError(
            file_, fmt::format("{} {}", element.name, index),
            fmt::format("is a polygon of {} corners, above the limit of {}", items,
                        limit_of(Limit::POLYGON_CORNERS)),
            "cut it into triangles where it was made, or " + raise_remedy(Limit::POLYGON_CORNERS));
    }
    if (text_) {
      for (; items > 0; --items)
        if (property.type.is_integer)
          text_->number<std::int64_t>(property.name.c_str());
        else
          text_->number<double>(property.name.c_str());
      return;
    }
    if (static_cast<std::uint64_t>(items) > rest_.size() / property.type.bytes)
      fail(element, index, ENDS_BEFORE);
    rest_.remove_prefix(static_cast<std::size_t>(items) * property.type.bytes);
  }

  std::optional<std::int64_t> read_whole_number(const ScalarType& type) {
    if (text_) return text_->number<std::int64_t>("the length of a list");
    if (rest_.size() < type.bytes) return std::nullopt;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
      const std::size_t at = form_ == Form::BIG_ENDIAN_BINARY ? i : type.bytes - 1 - i;
      bits = (bits << 8U) | static_cast<unsigned char>(rest_[at]);
    }
    rest_.remove_prefix(type.bytes);
    const std::uint64_t sign_bit = std::uint64_t{1} << (8 * type.bytes - 1);
    if (type.is_signed && (bits & sign_bit) != 0) return -1;
    return static_cast<std::int64_t>(bits);
  }

  [[noreturn]] void fail(const Element& element, std::int64_t index, const std::string& problem) const {
    throw InputError(file_, fmt::format("{} {} of {}", element.name, index, element.count), problem,
                     CUT_SHORT);
  }

  std::string_view rest_;
  std::size_t lines_before_;
  Form form_;
  std::string file_;
  std::optional<LineReader> text_;
};

}  // namespace

PlyContent check_ply(std::string_view bytes, const std::string& file) {
  HeaderReader header(bytes, file);
  const std::vector<Element> elements = header.read();
  BodyWalk(header, file).walk(elements);
  return {bytes.size() - header.body().size(), header.form() == Form::TEXT};
}

std::string with_its_first_byte(std::string_view ply, const PlyContent& content) {
  std::string result(ply);
  if (!content.is_text && ply.substr(content.offset).starts_with('\n') && ply[content.offset - 2] != '\r')
    result.insert(content.offset - 1, 1, '\r');
  return result;
}

namespace {

/// Bytes of a line per corner of a polygon: three indices of ten digits, and signs between.
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

/// Checks vertices in "v" and "f" lines.
class ObjVertices {
 public:
  void check(LineReader line, std::size_t number) {
    if (!line.next_line()) return;
    const std::string_view keyword = line.word();
    if (keyword == "v") {
      std::size_t numbers = 0;
      for (; numbers < 3 || !line.at_line_end(); ++numbers) line.number<double>("a coordinate");
      // A weight or a colour may follow; assimp drops other lines.
      if (numbers != 3 && numbers != 4 && numbers != 6)
        line.fail(fmt::format("a vertex of {} numbers", numbers));
      ++count_;
    }
    while (keyword == "f" && !line.at_line_end()) {
      const std::string_view corner = line.word();
      const auto named = line.number<std::int64_t>("a vertex index", corner.substr(0, corner.find('/')));
      if (named == 0 || -named > count_)
        line.fail(fmt::format("a face names vertex {}, but {} vertices stand before it", named, count_),
                  COUNTED);
      if (named > largest_) largest_ = named, line_of_largest_ = number;
    }
  }

  /// Call after the last line: a face may name vertices that come later.
  void check_largest(const std::string& file) const {
    if (largest_ > count_)
      throw InputError(file, fmt::format("line {}", line_of_largest_),
                       fmt::format("a face names vertex {}, but the file has {}", largest_, count_), COUNTED);
  }

 private:
  static constexpr const char* COUNTED =
      "vertices are counted from 1, backwards from -1; correct the index, or add the vertices that are "
      "missing";
  std::int64_t count_ = 0, largest_ = 0;
  std::size_t line_of_largest_ = 0;
};

}  // namespace

void check_obj(std::string_view text, const std::string& file) {
  const std::int64_t most_corners = limit_of(Limit::POLYGON_CORNERS);
  std::int64_t corners = 0;  // of the current face: a backslash at a line's end continues it
  std::int64_t length = 0;   // of the lines so joined
  bool in_face = false;
  std::string joined;  // Lines that are continued, without their backslashes.
  ObjVertices vertices;
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
    if (continues || !joined.empty()) joined.append(line.substr(0, line.find('\\'))).append(" ");
    if (continues) continue;
    vertices.check(LineReader(file, joined.empty() ? line : joined, number - 1), number);
    joined.clear();
    length = 0;
  }
  vertices.check_largest(file);
}

std::string without_materials(std::string_view text) {
  std::string result(text);
  for (std::size_t begin = 0; begin < result.size();) {
    const std::size_t end = std::min(result.find('\n', begin), result.size());
    const std::size_t word = result.find_first_not_of(" \t", begin);
    const std::string_view line = std::string_view(result).substr(begin, end - begin);
    if (word < end) {
      const std::string_view rest = line.substr(word - begin);
      // A comment with a backslash at its end must not swallow the next line.
      if (rest.starts_with("mtllib") || rest.starts_with("usemtl"))
        std::fill(result.begin() + static_cast<std::ptrdiff_t>(word),
                  result.begin() + static_cast<std::ptrdiff_t>(end), '#');
      else if (const std::size_t comment = result.find('#', word + 1); comment < end && result[word] != '#')
        std::fill(result.begin() + static_cast<std::ptrdiff_t>(comment),
                  result.begin() + static_cast<std::ptrdiff_t>(end), ' ');
    }
    begin = end + 1;
  }
  return result;
}

}  // namespace lmdbench
