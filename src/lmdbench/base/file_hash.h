// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lmdbench {

/// SHA-256 of a file's bytes, lower-case hexadecimal.
/// @throws InputError when it is not regular, not readable or larger than `Limit::FILE_BYTES`
std::string sha256_of_file(const std::filesystem::path& file);

/// SHA-256 of the bytes of a text, lower-case hexadecimal.
std::string sha256_of_text(std::string_view text);

}  // namespace lmdbench
