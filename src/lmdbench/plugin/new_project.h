// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lmdbench {

/// Languages that there is a project for: "c", "c++", "python".
const std::vector<std::string>& plugin_languages();

/// Writes a plugin that builds by itself (`cmake -S FOLDER -B FOLDER/build && cmake --build FOLDER/build`), with a copy of
/// lmdbench_method.h. The method is called as the folder is.
/// @return the name of the method, and of the shared object without ".so"
/// @throws UsageError for a language that there is none for, a folder whose name is no method's, or one that holds something already;
///         EnvironmentError where it cannot be written
std::string new_plugin(const std::filesystem::path& folder, const std::string& language);

}  // namespace lmdbench
