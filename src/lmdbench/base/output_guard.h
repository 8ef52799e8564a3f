// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lmdbench {

/// A kind of file that this program writes, and how it knows its own ones again.
struct OutputKind {
  std::string what;  ///< "result file", "path"
  /// Whether a file that is there is one of ours and may be replaced.
  std::function<bool(const std::filesystem::path& file)> is_ours;
};

/// @param what  would be written: "result file"
/// @throws UsageError for `-`, which people mean as standard output
void refuse_standard_output(const std::filesystem::path& file, const std::string& what,
                            const std::string& option);

/// @throws UsageError where something else than a folder stands in its place; EnvironmentError
/// where it stands above it, so that no folder can be made
void refuse_no_folder(const std::filesystem::path& folder, const std::string& option);

/// Makes sure that writing a file replaces nothing but an earlier output of the same kind: the name
/// is free, an empty file or one of ours. Refused: `-`, symbolic links (dangling ones, too),
/// directories, devices, FIFOs, foreign files, and any input under any name (hard links, too).
/// @param option  that named the file, for the remedy: "--out"
/// @throws UsageError; nothing was touched
void refuse_unsafe_output(const std::filesystem::path& file, const OutputKind& kind,
                          const std::vector<std::filesystem::path>& inputs, const std::string& option);

/// Whether the file begins with a text of at most 4096 bytes; false where it cannot be read. Does
/// not follow links.
bool file_begins_with(const std::filesystem::path& file, std::string_view start);

/// The first 4096 bytes of a regular file, or all of a shorter one; empty where it cannot be read.
std::string first_bytes(const std::filesystem::path& file);

}  // namespace lmdbench
