// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/json_text.h>
#include <lmdbench/base/limits.h>
#include <lmdbench/base/printable_text.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>
#include <set>

namespace lmdbench {
namespace {

std::string line_and_column(const std::string& text, std::size_t byte) {
  const std::size_t end = std::min(byte > 0 ? byte - 1 : 0, text.size());
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  const std::size_t line_begin =
      end == 0 ? 0 : text.rfind('\n', end - 1) + 1;  // npos + 1 is 0: the first line
  return fmt::format("line {}, column {}", line + 1, end - line_begin + 1);
}

[[noreturn]] void refuse_above(const std::string& file, const std::string& place, Limit limit,
                               const std::string& what) {
  throw UsageError(file, place, fmt::format("{}, above the limit of {}", what, limit_of(limit)),
                   "shorten it, or " + raise_remedy(limit));
}

/// Watches a parser: repeated keys, depth, length of texts. Throws for the last two, so that
/// hostile text is not read to its end.
class ParseWatch {
 public:
  /// @param place  of the whole text, such as an option; empty: a key's own is told
  ParseWatch(std::string file, std::string place) : file_(std::move(file)), place_(std::move(place)) {}

  bool operator()(int depth, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
    using Event = nlohmann::json::parse_event_t;
    const bool opens = event == Event::object_start || event == Event::array_start;
    if (opens && depth >= limit_of(Limit::JSON_DEPTH))
      refuse_above(file_, place_, Limit::JSON_DEPTH, "arrays or objects stand too deep inside each other");
    if ((event == Event::key || event == Event::value) && parsed.is_string()) {
      const auto length = static_cast<std::int64_t>(parsed.get_ref<const std::string&>().size());
      if (length > limit_of(Limit::JSON_TEXT))
        refuse_above(file_, place_, Limit::JSON_TEXT, fmt::format("a text of {} bytes", length));
    }
    if (event == Event::key) {
      open_.back().key = parsed.get<std::string>();
      if (!open_.back().keys.insert(open_.back().key).second && !repeated_key_) repeated_key_ = here();
    }
    if (event == Event::object_end || event == Event::array_end) open_.pop_back();
    const bool ends = event == Event::value || event == Event::object_end || event == Event::array_end;
    if (ends && !open_.empty()) ++open_.back().entries;
    if (opens) open_.push_back({.is_array = event == Event::array_start});
    return true;
  }

  void refuse_repeated_key() const {
    if (!repeated_key_) return;
    throw UsageError(file_, place_.empty() ? repeated_key_->to_string() : place_,
                     fmt::format("key \"{}\" appears twice in one object", repeated_key_->back()),
                     "remove one of the two: only one could take effect");
  }

 private:
  /// An array or object whose end is not read yet.
  struct Container {
    bool is_array = false;
    std::size_t entries = 0;  ///< That were read.
    std::string key = {};     ///< The last one.
    std::set<std::string> keys = {};
  };

  nlohmann::json::json_pointer here() const {
    nlohmann::json::json_pointer pointer;
    for (const Container& container : open_)
      container.is_array ? pointer /= container.entries : pointer /= container.key;
    return pointer;
  }

  std::string file_, place_;
  std::vector<Container> open_;
  std::optional<nlohmann::json::json_pointer> repeated_key_;
};

/// Nothing for a value that is no JSON.
std::optional<nlohmann::json> parse_value(const std::string& text, const std::string& place) {
  ParseWatch watch("", place);
  try {
    nlohmann::json value = nlohmann::json::parse(text, std::ref(watch), false);
    if (value.is_discarded()) return std::nullopt;
    watch.refuse_repeated_key();
    return value;
  } catch (const nlohmann::json::out_of_range&) {
    return std::nullopt;  // a number such as 1e999: the schema will say what is wanted
  }
}

/// "~1" and "~0" of a pointer's step; the step is known to be well-formed.
std::vector<std::string> steps_of(const std::string& pointer_text) {
  nlohmann::json::json_pointer pointer(pointer_text);
  std::vector<std::string> steps;
  for (; !pointer.empty(); pointer.pop_back()) steps.push_back(pointer.back());
  std::reverse(steps.begin(), steps.end());
  return steps;
}

/// The member of an array or object that a step names, made where it may be.
nlohmann::json& follow_step(nlohmann::json& parent, const std::string& step, const std::string& place) {
  if (parent.is_null())
    parent = step == "0" || step == "-" ? nlohmann::json::array() : nlohmann::json::object();
  if (parent.is_object()) return parent[step];
  if (!parent.is_array())
    throw UsageError("", place, "the pointer does not lead to a value of the experiment",
                     "use the pointers that 'lmdbench plan --json' shows");
  std::size_t index = parent.size();
  const bool appends = step == "-" || (step == "0" && parent.empty());
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  // Writing past an array's end would pad it with nulls, which no user wants.
  if (!appends && (error != std::errc{} || end != step.data() + step.size() || index >= parent.size()))
    throw UsageError("", place, fmt::format("a list of {} entries has no entry \"{}\"", parent.size(), step),
                     "count entries from 0, or append with /-");
  if (appends) return parent.emplace_back();
  return parent[index];
}

}  // namespace

nlohmann::json parse_json(const std::string& text, const std::string& file) {
  if (static_cast<std::int64_t>(text.size()) > limit_of(Limit::JSON_BYTES))
    refuse_above(file, "", Limit::JSON_BYTES, fmt::format("{} bytes of JSON", text.size()));
  ParseWatch watch(file, "");
  nlohmann::json document;
  try {
    document = nlohmann::json::parse(text, std::ref(watch));
  } catch (const nlohmann::json::parse_error& error) {
    throw UsageError(file, line_and_column(text, error.byte), "not JSON", "correct the syntax at this place");
  } catch (const nlohmann::json::out_of_range& error) {  // a number such as 1e999
    throw UsageError(file, "", fmt::format("a number is out of range: {}", error.what()),
                     "write numbers that a double holds");
  }
  watch.refuse_repeated_key();
  return document;
}

std::string json_line(const nlohmann::ordered_json& document) {
  return document.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void apply_override(nlohmann::json& document, const std::string& override_text) {
  constexpr std::size_t QUOTED_LENGTH = 200;
  const std::string place = "--set " + printable(override_text, QUOTED_LENGTH);
  const std::size_t equals = override_text.find('=');
  if (equals == std::string::npos || override_text.front() != '/')
    throw UsageError("", place, "not of the form /json/pointer=value",
                     "for example --set /driver/repetitions=3");
  if (!is_utf8(override_text)) throw UsageError("", place, "is no UTF-8", "write it in UTF-8");
  if (static_cast<std::int64_t>(override_text.size()) > limit_of(Limit::JSON_TEXT))
    refuse_above("", place, Limit::JSON_TEXT, fmt::format("a text of {} bytes", override_text.size()));
  const std::string value_text = override_text.substr(equals + 1);
  std::vector<std::string> steps;
  try {
    steps = steps_of(override_text.substr(0, equals));
  } catch (const nlohmann::json::exception&) {
    throw UsageError("", place, "the pointer does not lead to a value of the experiment",
                     "use the pointers that 'lmdbench plan --json' shows");
  }
  if (static_cast<std::int64_t>(steps.size()) > limit_of(Limit::JSON_DEPTH))
    refuse_above("", place, Limit::JSON_DEPTH, fmt::format("a pointer of {} steps", steps.size()));
  nlohmann::json* target = &document;
  for (const std::string& step : steps) target = &follow_step(*target, step, place);
  *target = parse_value(value_text, place).value_or(value_text);
}

namespace {

/// Walks through well-formed JSON and notes the line of each value.
class LineFinder {
 public:
  explicit LineFinder(const std::string& text) : text_(text) {}

  int find(const std::string& pointer) {
    wanted_ = pointer;
    value("");
    return line_;
  }

 private:
  /// The value at `here`. Enclosing values come first, so that the last match is the nearest one.
  void value(const std::string& here) {
    skip_blanks();
    if (wanted_ == here || wanted_.starts_with(here + "/"))
      line_ = 1 + static_cast<int>(
                      std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n'));
    if (text_[at_] == '{' || text_[at_] == '[') {
      container(here);
    } else if (text_[at_] == '"') {
      string();
    } else {
      at_ = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
    }
  }

  void container(const std::string& here) {
    const bool object = text_[at_++] == '{';
    for (std::size_t index = 0; skip_blanks(), text_[at_] != '}' && text_[at_] != ']'; ++index) {
      if (text_[at_] == ',') skip_one_and_blanks();
      std::string step = std::to_string(index);
      if (object) {
        step = escaped(string());
        skip_blanks();
        skip_one_and_blanks();  // the colon
      }
      value(fmt::format("{}/{}", here, step));
    }
    ++at_;
  }

  /// The string that begins here, with its escapes resolved.
  std::string string() {
    const std::size_t begin = at_++;
    while (text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    ++at_;
    return nlohmann::json::parse(text_.substr(begin, at_ - begin)).get<std::string>();
  }

  /// A key as a step of a JSON pointer (RFC 6901).
  static std::string escaped(const std::string& key) {
    std::string step;
    for (const char c : key) step += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return step;
  }

  void skip_blanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }
  void skip_one_and_blanks() {
    ++at_;
    skip_blanks();
  }

  const std::string& text_;
  std::string wanted_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

int line_of(const std::string& text, const std::string& pointer) {
  return LineFinder(text).find(pointer == "/" ? "" : pointer);
}

}  // namespace lmdbench
