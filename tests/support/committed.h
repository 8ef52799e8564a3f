// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <support/source_directory.h>

#include <string>

/// Experiments of the repository that tests run, with or without overrides.
namespace lmdbench::testing {

inline const std::string SHAPES_FILE = LMDBENCH_SOURCE_DIR "/experiments/shapes.json";
inline const std::string WALL_FILE = LMDBENCH_SOURCE_DIR "/experiments/wall.json";
inline const std::string LEVER_FILE = LMDBENCH_SOURCE_DIR "/experiments/wall-6dof.json";

}  // namespace lmdbench::testing
