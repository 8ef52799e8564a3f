// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace lmdbench {

/// Writes a file so that it has its old content or the whole new one, whenever the program ends: to
/// `<file>.part` beside it, flushed, then renamed. Missing folders are made.
/// @throws EnvironmentError when the disk or the permissions do not allow it
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

}  // namespace lmdbench
