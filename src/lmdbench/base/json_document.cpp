// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/json_document.h>
#include <lmdbench/base/json_schema.h>
#include <lmdbench/base/json_text.h>

#include <fmt/format.h>

#include <algorithm>

namespace lmdbench {
namespace {

[[noreturn]] void throw_error(ExitCode code, const std::string& file, const std::string& place,
                              const std::string& problem, const std::string& remedy) {
  if (code == ExitCode::USAGE) throw UsageError(file, place, problem, remedy);
  if (code == ExitCode::INPUT_DATA) throw InputError(file, place, problem, remedy);
  throw Error(code, file, place, problem, remedy);
}

}  // namespace

JsonDocument::JsonDocument(std::string text, std::string file, const nlohmann::json& schema, ExitCode code,
                           std::vector<std::string> overrides,
                           const std::function<void(nlohmann::json&)>& early)
    : text_(std::move(text)), file_(std::move(file)), code_(code), overrides_(std::move(overrides)) {
  locate([&] {
    json_ = parse_json(text_, file_);
    for (const std::string& entry : overrides_) override_with(entry, schema);
    if (early) early(json_);
    // Unknown keys first: the validator would report a misspelt key as a missing one.
    refuse_unknown_keys(json_, schema, file_);
    validate_against_schema(json_, schema, file_);
    fill_defaults(json_, schema);
  });
}

void JsonDocument::override_with(const std::string& entry, const nlohmann::json& schema) {
  const auto target_of = [](const std::string& override_text) {
    return override_text.substr(0, override_text.find('='));
  };
  apply_override(json_, entry);
  using Pointer = nlohmann::json::json_pointer;
  const std::string target = target_of(entry);
  // What encloses it may be new, too; not at the top, where scenes are told in two ways.
  for (Pointer here(target); !here.empty(); here.pop_back()) {
    if (here.parent_pointer().empty() && here.to_string() != target) break;
    for (const std::string& other : excluded_by(json_, schema, here.to_string())) {
      // Two overrides that exclude each other are refused below.
      const auto is_asked = [&](const std::string& asked) {
        return target_of(asked) == other || target_of(asked).starts_with(other + "/");
      };
      if (std::ranges::any_of(overrides_, is_asked)) continue;
      const Pointer pointer(other);
      notes_.push_back(fmt::format("{} takes the place of {}, which is {} in the file", target, other,
                                   json_[pointer].dump()));
      json_[pointer.parent_pointer()].erase(pointer.back());
    }
  }
}

void JsonDocument::fail(const std::string& pointer, const std::string& problem,
                        const std::string& remedy) const {
  throw_error(code_, file_, place(pointer), problem, remedy);
}

void JsonDocument::rethrow(const Error& error) const {
  // A message begins with file and place (error.h).
  const std::string message = error.what();
  const std::string about_this_file = file_ + ": ";
  // Errors about other files (a mesh that the document names) keep their own place and code.
  if (!message.starts_with(about_this_file)) throw_error(error.code(), "", "", message, "");
  const std::string rest = message.substr(about_this_file.size());
  const std::size_t end = rest.find(": ");
  // Checks for several kinds of files throw usage errors; this file has its own code.
  const ExitCode code = error.code() == ExitCode::USAGE ? code_ : error.code();
  const bool points =
      rest.starts_with("/") && end != std::string::npos && !rest.substr(0, end).ends_with(")");
  if (!points) throw_error(code, file_, "", rest, "");
  throw_error(code, file_, place(rest.substr(0, end)), rest.substr(end + 2), "");
}

std::string JsonDocument::place(const std::string& pointer) const {
  // A value of --set is in no line; the user has just typed it.
  for (const std::string& entry : overrides_) {
    const std::string target = entry.substr(0, entry.find('='));
    if (pointer == target || pointer.starts_with(target + "/") || target.starts_with(pointer + "/"))
      return pointer;
  }
  return fmt::format("{} (line {})", pointer, line_of(text_, pointer));
}

}  // namespace lmdbench
