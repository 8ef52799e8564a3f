// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// Languages that have a project template: "c", "c++", "python".
const std::vector<std::string>& plugin_languages();

/// Writes a plugin that builds by itself (`cmake -S FOLDER -B FOLDER/build && cmake --build
/// FOLDER/build`), with a copy of lmdbench_method.h. The folder's name is the method's.
/// @return the name of the method, and of the shared object without ".so"
/// @throws UsageError for an unknown language, a folder whose name no method can have, or one that
///         is not empty; EnvironmentError where it cannot be written
std::string new_plugin(const std::filesystem::path& folder, const std::string& language);

}  // namespace lmdbench
