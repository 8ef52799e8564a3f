// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace lmdbench {

/// Where the running program's data are: `share/lmdbench` beside the folder of an installed program (`bin/`), or beside
/// the program itself in a build tree, where it is a link to the sources. It holds `scripts/`, `experiments/`, `meshes/`
/// and `paths/`. Found from the place of the program, so that an installed tree may be moved.
/// @return empty where there is no such folder
std::filesystem::path data_folder();

/// The same for a program at `program`.
std::filesystem::path data_folder_of(const std::filesystem::path& program);

}  // namespace lmdbench
