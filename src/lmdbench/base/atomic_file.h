// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/file_descriptor.h>

#include <filesystem>
#include <functional>
#include <string_view>

namespace lmdbench {

/// Writes a file so that it has its old content or the whole new one, whenever the program ends: to
/// a part of its own beside it (`.<name>.<process>-<n>.part`, made exclusively), flushed, then
/// renamed. Two writers of one name each have their own part; the later one wins. Makes missing
/// folders. Replaces whatever has the name, a symbolic link too; call `refuse_unsafe_output` first.
/// @throws EnvironmentError when disk or permissions do not allow it; the part is then removed
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

/// The same; the new file stays open for reading and writing.
/// @param before_rename  gets the new file before it takes its name, to lock it
FileDescriptor replace_file(const std::filesystem::path& file, std::string_view content,
                            const std::function<void(int descriptor)>& before_rename);

}  // namespace lmdbench
