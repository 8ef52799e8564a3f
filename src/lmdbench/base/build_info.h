// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lmdbench {

/// What this program was built from and how.
struct BuildInfo {
  std::string version;         ///< "0.1.0"
  std::string git_commit;      ///< 40 hexadecimal digits, or "unknown" outside a git working copy
  std::string git_dirty;       ///< "yes" when sources differ from the commit, "no", or "unknown"
  std::string compiler;        ///< "GNU 12.2.0"
  std::string compiler_flags;  ///< Flags of the build type plus those of the project's settings
  std::string build_type;      ///< "Release"
  std::string target;          ///< "Linux x86_64"
  std::vector<std::pair<std::string, std::string>> libraries;  ///< Name and version, sorted by name
};

/// The git state is that of the moment of the build, not of the configuration.
const BuildInfo& build_info();

/// "lmdbench 0.1.0 (commit, dirty flag), compiler, flags, library versions": the text of `--version`.
std::string version_text();

}  // namespace lmdbench
