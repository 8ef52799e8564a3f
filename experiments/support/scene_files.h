// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/scene.h>

#include <filesystem>
#include <string>

namespace lmdbench::experiments {

/// Writes both meshes of a scene and a pose as files that `lmdbench query` reads.
/// @param folder is created if it is missing
/// @return the command that queries them
std::string write_scene(const Scene& scene, const Pose& X_WM, const std::string& method,
                        const std::filesystem::path& folder);

}  // namespace lmdbench::experiments
