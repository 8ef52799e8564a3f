// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/lmd/method_description.h>

#include <filesystem>
#include <vector>

/// Methods from outside: shared objects with the interface of lmdbench_method.h. An added method is
/// in the registry and taken wherever methods are; `MethodDescription::plugin` names its file.
namespace lmdbench {

/// Where a plugin runs.
enum class PluginTrust : std::uint8_t {
  NONE,    ///< In a process of its own for each pair of meshes: a crash or a hang costs the frame.
  TRUSTED  ///< In this process.
};

/// The checked descriptions of a plugin's methods; none of its code runs in this process yet.
/// @throws InputError naming the file and the fault: not loadable, another ABI, a bad name or one
///         that is in use, options that are no schema
std::vector<MethodDescription> plugin_methods(const std::filesystem::path& file, PluginTrust trust);

/// Adds its methods to the end of the registry. For the start of a program, as `set_limit`.
/// @throws InputError as above
void add_plugin(const std::filesystem::path& file, PluginTrust trust);

}  // namespace lmdbench
