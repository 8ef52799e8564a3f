// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/build_info.h>

#include <fmt/format.h>
#include <lmdbench_build_settings.h>  // made by CMake at configure time
#include <lmdbench_git_state.h>  // made by git_state.cmake at every build, changed only when git's state changes

#include <algorithm>

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

}  // namespace lmdbench
