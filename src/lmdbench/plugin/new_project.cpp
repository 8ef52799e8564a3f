// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/atomic_file.h>
#include <lmdbench/base/error.h>
#include <lmdbench/methods/registry.h>
#include <lmdbench/plugin/new_project.h>
#include <lmdbench/plugin/template_files.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <regex>
#include <set>
#include <string_view>
#include <system_error>

namespace lmdbench {

const std::vector<std::string>& plugin_languages() {
  static const std::vector<std::string> languages{"c", "c++", "python"};
  return languages;
}

std::string new_plugin(const std::filesystem::path& folder, const std::string& language) {
  namespace fs = std::filesystem;
  if (std::ranges::find(plugin_languages(), language) == plugin_languages().end())
    throw UsageError("", "--language", fmt::format("there is no project for \"{}\"", language),
                     fmt::format("take one of {}", fmt::join(plugin_languages(), ", ")));
  const fs::path whole = fs::absolute(folder).lexically_normal();
  std::string name =
      whole.has_filename() ? whole.filename().string() : whole.parent_path().filename().string();
  static const std::set<std::string> TARGETS{"all",     "clean",      "edit_cache",    "help", "install",
                                             "package", "preinstall", "rebuild_cache", "test"};
  if (TARGETS.contains(name))
    throw UsageError(folder.string(), "",
                     "the folder's name becomes a target's, and CMake has one of this name",
                     "call it otherwise");
  if (!std::regex_match(name, std::regex("[a-z][a-z0-9_-]{0,40}")))
    throw UsageError(folder.string(), "", "the folder's name becomes the method's, and cannot be one",
                     "take up to 41 small letters, digits, '-' and '_'");
  const std::vector<std::string> taken = method_names();
  if (std::ranges::find(taken, name) != taken.end())
    throw UsageError(folder.string(), "",
                     "the folder's name becomes the method's, and there is one of this name",
                     "call it otherwise");
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error)) &&
      !(fs::is_directory(folder, error) && fs::is_empty(folder, error)))
    throw UsageError(folder.string(), "", "is there already",
                     "name a folder that is not there, or an empty one");
  for (const TemplateFile& file : template_files()) {
    if (!file.language.empty() && file.language != language) continue;
    std::string text(file.text);
    constexpr std::string_view PLACE = "METHOD_NAME";
    // Not in the header, where words of its own begin with the same letters.
    for (std::size_t at = 0; !file.language.empty() && (at = text.find(PLACE, at)) != std::string::npos;
         at += name.size())
      text.replace(at, PLACE.size(), name);
    write_file_atomically(folder / file.name, text);
  }
  return name;
}

}  // namespace lmdbench
