// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/error.h>
#include <lmdbench/base/limits.h>

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace lmdbench {

/// A reader's knowledge of a file, for messages and limits.
struct InputKind {
  std::string what;                      ///< "mesh", "path", "experiment file"
  ExitCode code = ExitCode::INPUT_DATA;  ///< Of a file that cannot be read: this or USAGE.
  Limit most_bytes = Limit::FILE_BYTES;  ///< A larger file is refused.
  std::string remedy = "check the name and the permissions";  ///< For a file that is not there.
};

/// A file's bytes, read once: the parsed bytes are the hashed ones, even if the file changes.
struct FileContent {
  std::filesystem::path file;
  std::string bytes;
  std::string sha256;  ///< Of the bytes, lower-case hexadecimal.
};

/// For files that a library opens by name: refuses them as `read_input_file` would before reading.
/// @throws InputError or UsageError: no such file, no regular file
void refuse_unless_regular(const std::filesystem::path& file, const InputKind& kind);

/// A name without `..` and `.` where that names the same file: beyond a symbolic link to a folder
/// it may name another one, or none.
std::filesystem::path shortened(const std::filesystem::path& file);

/// Reads a regular file; follows symbolic links to one. Refuses directories, devices, FIFOs and
/// sockets without waiting for them.
/// @throws InputError (or UsageError: kind.code): missing, not regular, too large, unreadable
FileContent read_input_file(const std::filesystem::path& file, const InputKind& kind);

/// The text behind the UTF-8 byte order mark that some editors begin files with.
std::string_view without_byte_order_mark(std::string_view text);

/// Goes through text whose lines hold numbers, separated by blanks or commas; `#` begins a comment.
/// Skips lines without a number.
/// @param name for messages
/// @param remedy what a line should hold, for messages
/// @param use gets the place of a line, for messages ("line 7"), and its numbers
/// @throws InputError naming the line of a word that is no finite number, or of a comma with
/// nothing before or behind it
void for_each_number_line(
    const std::string& text, const std::string& name, const std::string& remedy,
    const std::function<void(const std::string& place, std::span<const double> numbers)>& use);

}  // namespace lmdbench
