// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/json_text.h>

#include <fmt/format.h>

#include <algorithm>
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

}  // namespace

nlohmann::json parse_json(const std::string& text, const std::string& file) {
  using Event = nlohmann::json::parse_event_t;
  std::vector<std::set<std::string>> keys_of_open_objects;
  std::string repeated_key;
  const auto watch_keys = [&](int, Event event, nlohmann::json& parsed) {
    if (event == Event::object_start) keys_of_open_objects.emplace_back();
    if (event == Event::object_end) keys_of_open_objects.pop_back();
    if (event == Event::key && !keys_of_open_objects.back().insert(parsed.get<std::string>()).second &&
        repeated_key.empty())
      repeated_key = parsed.get<std::string>();
    return true;
  };
  nlohmann::json document;
  try {
    document = nlohmann::json::parse(text, watch_keys);
  } catch (const nlohmann::json::parse_error& error) {
    throw UsageError(file, line_and_column(text, error.byte), "not JSON", "correct the syntax at this place");
  } catch (const nlohmann::json::out_of_range& error) {  // a number such as 1e999
    throw UsageError(file, "", fmt::format("a number is out of range: {}", error.what()),
                     "write numbers that a double holds");
  }
  if (!repeated_key.empty())
    throw UsageError(file, "", fmt::format("key \"{}\" appears twice in one object", repeated_key),
                     "remove one of the two: only one could take effect");
  return document;
}

void apply_override(nlohmann::json& document, const std::string& override_text) {
  const std::string place = "--set " + override_text;
  const std::size_t equals = override_text.find('=');
  if (equals == std::string::npos || override_text.front() != '/')
    throw UsageError("", place, "not of the form /json/pointer=value",
                     "for example --set /driver/repetitions=3");
  const std::string value_text = override_text.substr(equals + 1);
  nlohmann::json value = nlohmann::json::parse(value_text, nullptr, false);
  if (value.is_discarded()) value = value_text;
  try {
    const nlohmann::json::json_pointer pointer(override_text.substr(0, equals));
    const nlohmann::json::json_pointer parent = pointer.parent_pointer();
    // Writing past an array's end would pad it with nulls, which no user wants.
    if (document.contains(parent) && document.at(parent).is_array() && pointer.back() != "-" &&
        !document.contains(pointer))
      throw UsageError("", place,
                       fmt::format("{} has only {} entries", parent.to_string(), document.at(parent).size()),
                       "count entries from 0, or append with /-");
    document[pointer] = value;
  } catch (const nlohmann::json::exception&) {
    throw UsageError("", place, "the pointer does not lead to a value of the experiment",
                     "use the pointers that 'lmdbench plan --json' shows");
  }
}

}  // namespace lmdbench
