// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>

#include <fmt/format.h>
#include <lmdbench_build_settings.h>  // made by CMake at configure time
#include <lmdbench_git_state.h>       // made by git_state.cmake at every build

#include <algorithm>
#include <system_error>

namespace lmdbench {
namespace {

/// "assimp=5.2.5 fcl=0.7.0" as CMake found them.
std::vector<std::pair<std::string, std::string>> library_versions() {
  std::vector<std::pair<std::string, std::string>> versions;
  std::string_view found = LMDBENCH_LIBRARY_VERSIONS;
  while (!found.empty()) {
    const std::string_view entry = found.substr(0, found.find(' '));
    found.remove_prefix(std::min(found.size(), entry.size() + 1));
    const std::size_t equals = entry.find('=');
    versions.emplace_back(entry.substr(0, equals), entry.substr(equals + 1));
  }
  std::sort(versions.begin(), versions.end());
  return versions;
}

BuildInfo make_build_info() {
  BuildInfo info;
  info.version = LMDBENCH_VERSION;
  info.git_commit = LMDBENCH_GIT_COMMIT;
  info.git_dirty = LMDBENCH_GIT_DIRTY;
  info.compiler = LMDBENCH_COMPILER;
  info.compiler_flags = LMDBENCH_COMPILER_FLAGS;
  info.build_type = LMDBENCH_BUILD_TYPE;
  info.target = LMDBENCH_TARGET;
  info.libraries = library_versions();
  return info;
}

}  // namespace

const BuildInfo& build_info() {
  static const BuildInfo INFO = make_build_info();
  return INFO;
}

std::string version_text() {
  const BuildInfo& info = build_info();
  std::string text = fmt::format(
      "lmdbench {} (commit {}, local changes: {})\n{}, {}\ncompiled by {} with {}\n", info.version,
      info.git_commit, info.git_dirty, info.target, info.build_type, info.compiler, info.compiler_flags);
  std::string libraries;
  for (const auto& [name, version] : info.libraries) {
    libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
  }
  return text + "libraries: " + libraries;
}

EnvironmentError missing_part(const OptionalPart& part, const std::string& file, const std::string& place,
                              const std::string& what) {
  return {
      file, place, fmt::format("{} needs {}, which this build was made without", what, part.name),
      fmt::format("apt-get install {}, then configure with -D{}=ON and build", part.package, part.option)};
}

std::filesystem::path data_folder_of(const std::filesystem::path& program) {
  const std::filesystem::path share = std::filesystem::path("share") / "lmdbench";
  std::error_code none;
  for (const std::filesystem::path& prefix : {program.parent_path().parent_path(), program.parent_path()})
    if (std::filesystem::is_directory(prefix / share, none)) return prefix / share;
  return {};
}

std::filesystem::path data_folder() {
  std::error_code none;
  return data_folder_of(std::filesystem::read_symlink("/proc/self/exe", none));
}

}  // namespace lmdbench
