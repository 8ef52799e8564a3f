// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace lmdbench {

/// SHA-256 of a file's bytes, lower-case hexadecimal.
/// @throws InputError when the file cannot be read
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace lmdbench
