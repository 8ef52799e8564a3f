// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace lmdbench {

/// A file that is written beside its final name, as `<name>.part`, and takes that name in one step. Holds an
/// advisory lock on the `.part` file, so that two runs with the same output do not write into each other.
class PartFile {
 public:
  /// Makes missing parent directories and the empty `.part` file.
  /// @throws EnvironmentError when the name is a directory, when a directory or file cannot be made, or
  ///         when another process is writing the same result
  explicit PartFile(std::filesystem::path final_name);
  ~PartFile();  ///< Releases the lock; the `.part` file stays where `publish` was not reached.
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const std::filesystem::path& final_name() const { return final_name_; }
  const std::filesystem::path& part_name() const { return part_name_; }

  /// Writes the content, brings it to the disk and renames; what had the final name before is replaced at
  /// once. May be tried again when it failed.
  /// @throws EnvironmentError; the earlier file of the final name is then untouched and the `.part`
  ///         file empty
  void publish(std::span<const std::byte> content);

 private:
  void open_and_lock();
  void write(std::span<const std::byte> content);

  std::filesystem::path final_name_;
  std::filesystem::path part_name_;
  int descriptor_ = -1;
};

}  // namespace lmdbench
