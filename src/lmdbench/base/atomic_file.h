// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/file_descriptor.h>

#include <filesystem>
#include <functional>
#include <string_view>

namespace lmdbench {

/// Writes a file so that it has its old content or the whole new one, whenever the program ends: to a file of
/// its own beside it (`.<name>.<process>-<n>.part`, made exclusively), flushed, then renamed. Two writers of one name
/// do not meet: each writes its own part and the later one stands. Missing folders are made. What has the name
/// is replaced, a symbolic link itself and not where it leads; `refuse_unsafe_output` comes before.
/// @throws EnvironmentError when the disk or the permissions do not allow it; the part is then removed
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

/// The same; the new file stays open for reading and writing.
/// @param before_rename  is given the new file before it takes its name, for a lock
FileDescriptor replace_file(const std::filesystem::path& file, std::string_view content,
                            const std::function<void(int descriptor)>& before_rename);

}  // namespace lmdbench
