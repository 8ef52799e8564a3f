// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lmdbench/base/file_descriptor.h>

#include <filesystem>
#include <string_view>

namespace lmdbench {

/// File `<name>.part` beside its final name in which a run writes until it is complete. Holds an
/// advisory lock, so that two runs with the same output do not write into each other. The part is
/// new or left by an earlier run: never a link, never a foreign file.
class PartFile {
 public:
  /// Makes missing parent directories and, unless an earlier run left one, an empty part.
  /// @throws EnvironmentError when the name is a directory, when a directory or file cannot be
  ///   made, when another process is writing the same result, or when the part is no file of ours
  explicit PartFile(std::filesystem::path final_name);
  ~PartFile() = default;  ///< Releases the lock; the part stays unless removed or published.
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const std::filesystem::path& final_name() const { return final_name_; }
  const std::filesystem::path& part_name() const { return part_name_; }
  int descriptor() const { return descriptor_.get(); }

  bool is_empty() const;
  /// @throws EnvironmentError: the part is of somebody else, whoever finds that out
  [[noreturn]] void refuse_foreign() const;

  /// Gives the part this content in one step, flushed to the disk.
  /// @throws EnvironmentError, for example when the disk is full; the part is then as before
  void write(std::string_view content);

  /// Removes the part, once; it must not be written any more.
  void remove();
  bool is_removed() const { return removed_; }

  /// Writes the final file in one step (`write_file_atomically`), then removes the part. May be
  /// repeated after a failure.
  /// @throws EnvironmentError; the earlier file of the final name and the part are then untouched
  void publish(std::string_view content);

 private:
  void open_and_lock();

  std::filesystem::path final_name_;
  std::filesystem::path part_name_;
  FileDescriptor descriptor_;
  bool removed_ = false;
};

}  // namespace lmdbench
