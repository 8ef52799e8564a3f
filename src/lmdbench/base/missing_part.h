// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/error.h>

#include <string>

namespace lmdbench {

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

/// What this build lacks and somebody asks for: the message names the part, its package and its option.
/// @param file,place where it is asked for; may be empty
/// @param what       that needs it
EnvironmentError missing_part(const OptionalPart& part, const std::string& file, const std::string& place,
                              const std::string& what);

}  // namespace lmdbench
