// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/error.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lmdbench {

/// What this program was built from and how.
struct BuildInfo {
  std::string version;         ///< "1.0.0"
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

/// "lmdbench 1.0.0 (commit, dirty flag), compiler, flags, library versions", for `--version`.
std::string version_text();

/// A library that a build may do without (the options LMDBENCH_WITH_... of CMakeLists.txt).
struct OptionalPart {
  const char* name;     ///< "FCL"
  const char* option;   ///< "LMDBENCH_WITH_FCL"
  const char* package;  ///< Debian's: "libfcl-dev"
};

inline constexpr OptionalPart PART_FCL{"FCL", "LMDBENCH_WITH_FCL", "libfcl-dev"};
inline constexpr OptionalPart PART_ASSIMP{"assimp", "LMDBENCH_WITH_ASSIMP", "libassimp-dev"};
inline constexpr OptionalPart PART_HDF5{"HDF5", "LMDBENCH_WITH_HDF5",
                                        "libhdf5-dev libboost-dev libxxhash-dev"};

/// The error about a part that this build lacks; the message names it, its package and its option.
/// @param file,place where it is needed; may be empty
/// @param what       needs it
EnvironmentError missing_part(const OptionalPart& part, const std::string& file, const std::string& place,
                              const std::string& what);

/// Folder of the running program's data: `share/lmdbench` beside the folder of an installed program
/// (`bin/`), or beside the program in a build tree, where it links to the sources. It holds
/// `scripts/`, `experiments/`, `meshes/` and `paths/`. An installed tree may be moved.
/// @return empty where there is no such folder
std::filesystem::path data_folder();

/// The same for a program at `program`.
std::filesystem::path data_folder_of(const std::filesystem::path& program);

}  // namespace lmdbench
